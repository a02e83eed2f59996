// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "kerf/force.hpp"
#include "kerf/powered_cutter.hpp"
#include "saw_blade.h"
#include "saw_parameters.h"
#include "stroke.h"

/// The teeth in bone: their positions and the bone that they meet.
namespace kerf::sawing {

inline constexpr double max_cutting_gap = 0.1e-3;  ///< [m] teeth this much farther from the front than the nearest one
                                                   ///< do not cut yet

/// The saw's motion as the law uses it.
struct Oscillation {
    Stroke stroke;            ///< its rate is at least the slowest that cuts
    CuttingState cutting;     ///< cutting state of the teeth
    double phase = 0.0;       ///< [rad]
    bool is_averaged = true;  ///< over the oscillation, above 100 Hz and while the saw passes lower rates

    /// Returns the blade's displacement in its swing, in the unit of its amplitude; 0 if averaged.
    template <class Blade>
    [[nodiscard]] double swing(const Blade& blade) const noexcept {
        return is_averaged ? 0.0 : blade.amplitude() * sin_cos_exact(phase).sin;
    }
};

/// All teeth, with one bone sample for each point. A swinging tooth represents a pitch of the front. It has two points,
/// a quarter of a pitch to either side of its tip, each for half of the pitch. Without averaging both are the tip
/// itself.
struct TeethInBone {
    Teeth teeth;
    std::array<double, 2 * max_teeth> engagement;  ///< [–] of each point: 0 in air … 1 in bone
    std::array<double, 2 * max_teeth> resisted;    ///< [–] resistance of each point, relative to the reference tissue
    std::array<double, 2 * max_teeth> gap;         ///< [m] to the front, along the tooth's normal
    double engaged = 0.0;                          ///< [–] number of teeth in bone

    template <class Blade>
    void sample(const SawParameters& law, const BoneQuery& bone, const Blade& blade,
                const Oscillation& motion) noexcept;
    /// Returns the smallest gap to the front [m] of the teeth in bone, from `first` up to but without `last`; infinite
    /// if none is in bone.
    [[nodiscard]] double min_gap(std::size_t first, std::size_t last) const noexcept {
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 2 * first; i < 2 * last; ++i)
            if (resisted[i] > 0.0) least = std::min(least, gap[i]);
        return least;
    }
    /// Returns the resistance of all teeth, in teeth of the reference tissue.
    [[nodiscard]] double resisting() const noexcept {
        double sum = 0.0;
        for (std::size_t i = 0; i < 2 * teeth.count; ++i) sum += 0.5 * resisted[i];
        return sum;
    }
};

}  // namespace kerf::sawing
