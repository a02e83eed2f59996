// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "documents/anatomy.h"
#include "documents/measure_plan.h"
#include "documents/yaml/read_map.h"

namespace kerf::documents {

/// Reads `constructions:`. A construction refers to landmarks that the procedure needs, and to constructions above it.
/// @param landmarks   `needs.landmarks`
[[nodiscard]] std::vector<Construction> read_constructions(const Node& node, const std::vector<std::string>& landmarks,
                                                           Report& report);

/// Reads `measures:`.
[[nodiscard]] std::vector<Measure> read_measures(const Node& node, const std::vector<std::string>& landmarks,
                                                 const std::vector<Construction>& constructions, Report& report);

/// Reports constructions and measures that use a landmark of the wrong sort, such as the angle of a point.
void check_sorts(const std::vector<Construction>& constructions, const std::vector<Measure>& measures,
                 const Anatomy& anatomy, const Document& document, Report& report);

}  // namespace kerf::documents
