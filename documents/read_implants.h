// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "documents/implant_plan.h"
#include "documents/yaml/read_map.h"

namespace kerf::documents {

/// Reads `implants:`, each with its solid, its holes and its place. The axis of a place is not checked.   [main]
[[nodiscard]] std::vector<Implant> read_implants(const Node& node, Report& report);

/// Reports the axis of a step that names no hole, or a hole of an implant without a place (E0524).
/// @param named   the implant and hole that the axis names
/// @param place   of `implants:` in the document   [main]
void check_named_hole(const Node& axis, const NamedHole& named, const Node& place, Report& report);

}  // namespace kerf::documents
