// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "documents/procedure_context.h"

namespace kerf::documents {

/// Reads `scoring:`. Pre: steps, measures and instruments are read.   [main]
[[nodiscard]] std::vector<ScoredMetric> read_scoring(const Node& node, const ProcedureContext& reading);

}  // namespace kerf::documents
