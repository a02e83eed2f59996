// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "studies/chart/powered/powered_scene.h"
#include "studies/chart/run.h"

/// Ways to make the force of a powered cutter. For training and research; not for diagnosis, planning or deciding
/// treatment.
namespace kerf::chart {

struct PoweredMethod {
    std::string id{}, title{};
    Knob knob = Knob::spacing;
    std::vector<Fineness> sweep{};  ///< coarse to fine
    bool is_as_printed = false;
    bool is_solved = false;      ///< the tool finds its own motion
    bool is_calibrated = false;  ///< its one constant is set in a block of the hardest tissue
    double more_points = 0.0;    ///< how many times the points S-07 takes; 0: it has none
    std::function<std::unique_ptr<Run>(const PoweredScene&, const Fineness&, double gain)> start{};
};

/// Every method that the plugins allow on the cutter of a scene.
///
///     M2   the plugin's law in binary voxels
///     M10  on Kerf's fields at a prescribed motion; once more by points, where the law has a parameter for them
///     M9   the same with proxy and virtual coupling: what Kerf does
///     and the scene's rivals, on Kerf's fields at a prescribed motion
///
/// @param quick  two steps of each knob   [main]
[[nodiscard]] std::vector<PoweredMethod> powered_methods(const Plugins& plugins, const PoweredScene& scene, bool quick);

/// Why the exact law of a scene cannot be made: a plugin or a parameter is missing. For people; empty: it can.   [main]
[[nodiscard]] std::string why_no_exact_law(const Plugins& plugins, const PoweredScene& scene);

/// The tool of a scene as the host loads it, at this many points.   [main]
[[nodiscard]] ToolSetup tool_of(const Plugins& plugins, const PoweredScene& scene, int points);

}  // namespace kerf::chart
