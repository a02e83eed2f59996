// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "documents/procedure_context.h"

namespace kerf::documents {

/// Reads a goal of a step.
/// @param law   of the step's instrument; null: it is unknown, and no signal is refused   [main]
[[nodiscard]] Goal read_goal(const Node& item, const ComponentInfo* law, const ProcedureContext& reading);

/// Reads a limit of a step, likewise.   [main]
[[nodiscard]] Limit read_limit(const Node& item, const ComponentInfo* law, const ProcedureContext& reading);

/// Reports goals that break a limit of their step, and limits that exclude each other.   [main]
void refuse_contradictions(const Step& step, const Node& item, Report& report);

}  // namespace kerf::documents
