// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "run/exact/exact_strategies.h"

namespace kerf {

inline constexpr double in_air_before_entry = 2e-3;  ///< [m] that the planned cut of a step begins in air

/// What a way to make a surface costs, and how far it is off, for the planned cut of a step.
struct StrategyCost {
    std::string strategy;   ///< "isosurface": the field's own surface
    double removed = 0.0;   ///< [m³]
    double farthest = 0.0;  ///< [m] between its surface and that of the last strategy, near the cut, either way
    double seconds = 0.0;   ///< by the clock
    std::size_t triangles = 0;
    std::string why_not;  ///< it made no surface; for people
};

/// Cuts the bone of a scene by the tool of a step, straight along its planned axis. Returns the field's surface first,
/// then one for each strategy. The last one is what the others are compared with: let it be the exact one.   [main]
/// @param depth        [m] past the entry
/// @param strategies   full ids
[[nodiscard]] std::vector<StrategyCost> compare_strategies(const Scene& scene, std::size_t step, double depth,
                                                           const StrategyHost& host,
                                                           const std::vector<std::string>& strategies,
                                                           const std::function<void(const std::string& what)>& report);

}  // namespace kerf
