// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "conformance/chart/method.h"

/// One marker of the chart. For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::chart {

struct Cost {
    double median = 0.0, p999 = 0.0, longest = 0.0;  ///< [µs] per tick, on the processor
};

struct Measured {
    double force_error = 0.0;   ///< [–] RMS|F − F_ref| / RMS|F_ref|, all grids together
    double worst_grid = 0.0;    ///< [–] of the grid on which it is largest
    double volume_error = 0.0;  ///< [–] |V − V_exact| / V_exact, mean of the grids
    double peak_step = 0.0;  ///< [–] largest step from tick to tick beside the reference's own, of the largest |F_ref|
    double off_lateral = 0.0;  ///< [N] largest force across the shaft where the reference has none over 1 N
    double reference = 0.0;    ///< [N] RMS|F_ref|
    double gain = 1.0;         ///< [–] its calibration
    Cost cost;
    bool is_finite = true;  ///< every force was
};

/// The gain with which a method's mean thrust in whole cortical bone, at the scene's feed and drill, is the
/// reference's. 1 for methods that are not calibrated.   [main]
[[nodiscard]] double calibration(const Method& method, const Scene& scene, const CuttingLaw& law,
                                 const Fineness& fineness);

/// Runs the method through the scene on so many grids, each shifted by another part of a voxel, and holds it against
/// the exact law.   [main]
[[nodiscard]] Measured measure(const Method& method, const Scene& scene, const CuttingLaw& law,
                               const Fineness& fineness, int grids);

/// A block of cortical bone that the scene's drill goes into at the scene's feed.
[[nodiscard]] Scene block_scene(const Scene& like, double depth);

}  // namespace kerf::chart
