// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "studies/chart/powered/powered_scene.h"

/// What is right for a powered cutter. For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::chart {

/// Along one motion, a sample a tick.
struct PoweredReference {
    std::vector<Vec6> wrench{};    ///< bone on tool about its tip, tool frame [N, N·m]
    std::vector<bool> is_exact{};  ///< else it is that of a replay
    double volume = 0.0;           ///< [m³]
};

/// The poses and rates of a motion, a sample a tick.
struct Motion {
    std::vector<Pose> from{};
    std::vector<Vec6> rate{};
};
[[nodiscard]] Motion prescribed_motion(const PoweredScene& scene);
[[nodiscard]] Motion motion_of(const std::vector<Felt>& felt);

/// The exact law along a motion. Where it says nothing, and for volumes that have no closed form, the same physics on
/// grids of 0.2 and 0.1 mm with the most points, its law at that motion: forces of the finer grid, volume
/// Richardson-extrapolated.   [main]
[[nodiscard]] PoweredReference reference_along(const Plugins& plugins, const PoweredScene& scene, const Motion& motion,
                                               bool is_prescribed);

}  // namespace kerf::chart
