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

/// The teeth in the bone: where they are, what they meet.
namespace kerf::sawing {

inline constexpr double left_behind = 0.1e-3;  ///< [m] teeth farther from the front than the nearest by this wait (R2)

/// How the saw moves, as the law takes it.
struct Oscillation {
    Stroke stroke;            ///< its rate never below the slowest that cuts
    CuttingState cutting;     ///< how far the teeth cut
    double phase = 0.0;       ///< [rad]
    bool is_averaged = true;  ///< over the oscillation: above 100 Hz, and on the way there and back

    /// Where the blade is in its swing, in the unit of its amplitude. Averaged: in the middle.
    template <class Blade>
    [[nodiscard]] double swing(const Blade& blade) const noexcept {
        return is_averaged ? 0.0 : blade.amplitude() * sin_cos_exact(phase).sin;
    }
};

/// All teeth, sampled once. As they swing, each stands for a pitch of the front: two points a tooth, a quarter of a
/// pitch to either side of its tip, each for a half of it. Where forces are not averaged both are the tip itself.
struct TeethInBone {
    Teeth teeth;
    std::array<double, 2 * most_teeth> engagement;  ///< [–] of each point: 0 in air … 1 in bone
    std::array<double, 2 * most_teeth> resisted;    ///< [–] of each point: share of the reference tissue's resistance
    std::array<double, 2 * most_teeth> gap;         ///< [m] to the front, along the tooth's normal
    double engaged = 0.0;                           ///< [–] how many are in bone

    template <class Blade>
    void sample(const SawParameters& law, const BoneQuery& bone, const Blade& blade,
                const Oscillation& motion) noexcept;
    /// The least way to the front of those in bone [m], of the teeth from `first` to before `last`; infinite where none
    /// is.
    [[nodiscard]] double least_gap(std::size_t first, std::size_t last) const noexcept {
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 2 * first; i < 2 * last; ++i)
            if (resisted[i] > 0.0) least = std::min(least, gap[i]);
        return least;
    }
    /// What they resist together, in teeth.
    [[nodiscard]] double resisting() const noexcept {
        double sum = 0.0;
        for (std::size_t i = 0; i < 2 * teeth.count; ++i) sum += 0.5 * resisted[i];
        return sum;
    }
};

}  // namespace kerf::sawing
