// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "kerf/math.hpp"
#include "twist_drill.h"

/// Division of the feed among the cutting edges.
namespace kerf::drilling {

/// Recent motion of the drill, tool frame.
struct Travel {
    double feed_rate = 0.0;  ///< [m/s] in the last tick, ≥ 0
    Vec6 mean{};             ///< [m/s, rad/s] averaged over half a turn, the delay between the two lips
    Vec6 last{};             ///< [m/s, rad/s] in the last tick
    Vec6 over_turns{};       ///< [m/s, rad/s] first filter stage of `steady`
    Vec6 steady{};           ///< [m/s, rad/s] filtered twice over turns, which removes the swing of a tip with runout

    /// Updates the averages after a tick of `dt` [s] at `n` revolutions a second.
    void advance(const Vec6& rate, double dt, double n) noexcept {
        feed_rate = std::max(0.0, rate[2]);
        last = rate;
        const double turns = n * dt, weight = std::min(1.0, lip_count * turns),
                     slow_weight = std::min(1.0, turns / 1.5);
        for (std::size_t i = 0; i < mean.size(); ++i) {
            mean[i] += weight * (rate[i] - mean[i]);
            over_turns[i] += slow_weight * (rate[i] - over_turns[i]);
            steady[i] += slow_weight * (over_turns[i] - steady[i]);
        }
    }
};

/// Chip and edge force of a piece of an edge, as fractions of an even chip's [–].
struct ChipFraction {
    double chip;  ///< above 1 where other pieces take less
    double edge;  ///< 1 at most
};

/// The chip of one lip under a steady feed.
class EvenChip {
public:
    EvenChip(double feed_per_lip, double edge_depth) noexcept;

    /// Returns the chip and edge fraction of a piece that takes the fraction c_0 of the even chip and lies g [m] behind
    /// the foremost piece. The other lip left this piece's front half a turn ago.
    ///
    ///     c = max(0, c_0 − g/t),   edge: min(1, (1 − e^(−c t/t_e))/(1 − e^(−t/t_e))),   t = max(f/2, t_e)
    [[nodiscard]] ChipFraction taken(double weight, double behind) const noexcept;

private:
    double thickness_, edge_depth_, built_up_;
};

/// Returns each lip's fraction of an even chip [–] under runout. The first lip takes the feed that the lagging second
/// lip cannot reach.
///
///     t_2 = max(0, f/2 − G),   t_1 = f − t_2,    G the lag of the second lip, f the feed per revolution
[[nodiscard]] std::array<double, lip_count> lip_fractions(double lag, double feed_per_revolution) noexcept;

}  // namespace kerf::drilling
