// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "studies/chart/surfaces/groove_surfaces.h"

/// The surfaces of a burr's scenes next to each other. For training and research; not for diagnosis, planning or
/// deciding treatment.
namespace kerf::chart {

/// One way at one fineness on one groove.
struct SurfaceRow {
    std::string scene{};   ///< whose groove it is
    std::string groove{};  ///< "1 mm deep"
    std::string maker{}, knob{};
    double volume = 0.0;  ///< [m³] in closed form
    GrooveSurface made{};
};

/// The strategies that are compared, by full id: the burr's own, what cuts what that declines, and the reference.
inline constexpr const char* surface_strategies[] = {"kerf.burring.displace", "kerf.remesh_cgal.local",
                                                     "kerf.remesh_cgal.exact"};

/// A strategy by its full id; empty where there is none.
using FindStrategy = std::function<bone::StrategyCall(const std::string& id)>;

/// Field, the burr's strategy with the second for what it declines, and the reference, on the grooves of a scene; none
/// where the scene has no groove, or a strategy is missing.   [main]
/// @param quick  two values of each knob
[[nodiscard]] std::vector<SurfaceRow> burr_surfaces(const std::string& scene, const FindStrategy& find, bool quick);

/// A row for each. The first line, a comment, says what it is not for.
[[nodiscard]] std::string surfaces_csv(const std::vector<SurfaceRow>& rows);
/// Error of the volume, and of the walls, over the cost of a step: a panel of each for each groove.
[[nodiscard]] std::string surfaces_svg(const std::vector<SurfaceRow>& rows);

}  // namespace kerf::chart
