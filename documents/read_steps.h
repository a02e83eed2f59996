// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "documents/procedure_context.h"

namespace kerf::documents {

/// Reads one step, with a limit for each event that spoils its tool.   [main]
[[nodiscard]] Step read_step(const Node& item, const ProcedureContext& reading);

}  // namespace kerf::documents
