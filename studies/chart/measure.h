// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "studies/chart/method.h"

/// One marker of the chart. For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::chart {

struct Cost {
    double median = 0.0, p999 = 0.0, longest = 0.0;  ///< [µs] per tick, on the processor
};

struct Measured {
    double force_error =
        0.0;  ///< [–] RMS|F − F_ref| / RMS|F_ref|, all grids together; of a method that `walks`, of the thrust
    double worst_grid = 0.0;    ///< [–] of the grid on which it is largest
    double volume_error = 0.0;  ///< [–] |V − V_exact| / V_exact, mean of the grids
    double peak_step = 0.0;  ///< [–] largest step from tick to tick beside the reference's own, of the largest |F_ref|
    double off_lateral = 0.0;  ///< [N] largest force across the shaft where the reference has none over 1 N
    double reference = 0.0;    ///< [N] RMS|F_ref|
    double gain = 1.0;         ///< [–] its calibration
    double same_hand =
        0.0;  ///< [–] RMS of how far its thrust is from what the same hand feels on the finest grid, of that one's RMS
    double same_hand_turn = 0.0;  ///< [–] the same of means over a turn of the spindle
    double apart = 0.0;           ///< [m] how far its tip comes from where that hand leads it there, at most
    Cost cost;
    bool is_finite = true;  ///< every force was; those that were not count in nothing else
};

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
