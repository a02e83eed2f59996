// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "run/exact/exact_strategies.h"

namespace kerf::run {

inline constexpr double in_air_before_entry = 2e-3;  ///< [m] travel in air before the entry in a planned cut

/// Cost and error of a method to make the surface of a step's planned cut.
struct StrategyCost {
    std::string strategy;  ///< "isosurface": the field's own surface
    double removed = 0.0;  ///< [m³]
    /// [m] distance between its surface and the last strategy's, near the cut, the larger of both directions.
    double farthest = 0.0;
    double seconds = 0.0;  ///< by the clock
    std::size_t triangles = 0;
    std::string why_not;  ///< the reason for no surface; for people
};

/// Cuts the scene's bone with the tool of a step, straight along its planned axis. Returns the field's surface first,
/// then one per strategy. The last strategy is the reference for the others: pass the exact one last.   [main]
/// @param depth        [m] beyond the entry
/// @param strategies   full ids
[[nodiscard]] std::vector<StrategyCost> compare_strategies(const Scene& scene, std::size_t step, double depth,
                                                           const StrategyHost& host,
                                                           const std::vector<std::string>& strategies,
                                                           const std::function<void(const std::string& what)>& report);

}  // namespace kerf::run
