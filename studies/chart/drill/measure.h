// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "studies/chart/drill/method.h"
#include "studies/chart/track.h"

/// One marker of a drill. For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::chart {

/// The gain with which a method's mean thrust in whole cortical bone, at the scene's feed and drill, is the
/// reference's. 1 for methods that are not calibrated.   [main]
[[nodiscard]] double calibration(const Method& method, const Scene& scene, const CuttingLaw& law,
                                 const Fineness& fineness);

/// What drills that walk are held against; shifted as none of the grids that `measure` takes.
inline constexpr Fineness finest{0.1e-3, 31, {0.41, 0.77, 0.23}};
/// What a hand that leads the method through the scene feels.   [main]
[[nodiscard]] std::vector<Felt> led_by_hand(const Method& method, const Scene& scene, const Fineness& fineness);

/// Runs the method through the scene on so many grids, each shifted by another part of a voxel, and holds it against
/// the exact law.   [main]
/// @param led  what `led_by_hand` has felt on the finest grid, to hold it against that too; may be empty
[[nodiscard]] Measured measure(const Method& method, const Scene& scene, const CuttingLaw& law,
                               const Fineness& fineness, int grids, const std::vector<Felt>& led = {});

/// A block of cortical bone that the scene's drill goes into at the scene's feed.
[[nodiscard]] Scene block_scene(const Scene& like, double depth);

}  // namespace kerf::chart
