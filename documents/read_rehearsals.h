// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "documents/procedure_context.h"

namespace kerf::documents {

/// Reads `rehearsals:` and the `paths:` that they follow. Either may be null.   [main]
[[nodiscard]] std::vector<Rehearsal> read_rehearsals(const Node* paths, const Node* rehearsals,
                                                     const ProcedureContext& reading);

}  // namespace kerf::documents
