// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "studies/chart/powered/powered_methods.h"
#include "studies/chart/powered/powered_reference.h"
#include "studies/chart/track.h"
#include "studies/chart/trial.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::chart {

/// Runs the method along the scene's path on so many grids and compares it with the reference: of the path itself, or,
/// where the method finds its own motion, of that.   [main]
/// @param prescribed  the reference of the scene's path
[[nodiscard]] Measured measure_powered(const Plugins& plugins, const PoweredMethod& method, const PoweredScene& scene,
                                       const PoweredReference& prescribed, const Fineness& fineness, int grids,
                                       double gain);

/// The gain with which a method's mean thrust in a block is the reference's. 1 for methods that are not calibrated.
/// [main]
[[nodiscard]] double powered_calibration(const Plugins& plugins, const PoweredMethod& method, const PoweredScene& scene,
                                         const Fineness& fineness);

/// The tests that apply to a powered cutter, each in a block at one fineness: S-07 where the law has sample points,
/// S-12, S-19, and P9 of what is not solved.   [main]
[[nodiscard]] Standing powered_standing(const Plugins& plugins, const PoweredMethod& method, const PoweredScene& scene,
                                        const Fineness& fineness);

}  // namespace kerf::chart
