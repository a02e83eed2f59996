// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "kerf/math.hpp"
#include "twist_drill.h"

/// Who of the edges takes how much of the feed.
namespace kerf::drilling {

/// How the drill has gone.
struct Travel {
    double feed_rate = 0.0;  ///< [m/s] in the last law, ≥ 0
    Vec6 mean{};        ///< [m/s, rad/s] of the tool, tool frame, over half a turn: what one lip leaves to the other
    Vec6 last{};        ///< [m/s, rad/s] in the last tick
    Vec6 over_turns{};  ///< [m/s, rad/s] the first of the two filters of `steady`
    Vec6 steady{};  ///< [m/s, rad/s] over turns, twice filtered: without what a tip that runs off goes round with them

    /// After a tick of `dt` [s] at n revolutions a second.
    void advance(const Vec6& rate, double dt, double n) noexcept {
        feed_rate = std::max(0.0, rate[2]);
        last = rate;
        const double turns = n * dt, share = std::min(1.0, lip_count * turns), slow_share = std::min(1.0, turns / 1.5);
        for (std::size_t i = 0; i < mean.size(); ++i) {
            mean[i] += share * (rate[i] - mean[i]);
            over_turns[i] += slow_share * (rate[i] - over_turns[i]);
            steady[i] += slow_share * (over_turns[i] - steady[i]);
        }
    }
};

/// What a piece of an edge takes: shares of an even chip and of its edge force [–].
struct Taken {
    double chip;  ///< more than 1 where others take less
    double edge;  ///< at most 1
};

/// The chip of one lip in a feed that is even.
class EvenChip {
public:
    EvenChip(double feed_per_lip, double edge_depth) noexcept;

    /// What a piece takes whose share of it is c_0 and that lies g behind the foremost: its front was left half a turn
    /// ago, by the other lip.
    ///
    ///     c = max(0, c_0 − g/t),   edge: min(1, (1 − e^(−c t/t_e))/(1 − e^(−t/t_e))),   t = max(f/2, t_e)
    [[nodiscard]] Taken taken(double share, double behind) const noexcept;

private:
    double thickness_, edge_depth_, built_up_;
};

/// How two lips share the feed when the tip runs out [–] of an even chip: the first takes what the second is too far
/// behind to reach.
///
///     t_2 = max(0, f/2 − G),   t_1 = f − t_2,    G the lag of the second lip, f the feed per revolution
[[nodiscard]] std::array<double, lip_count> share_of_lips(double lag, double feed_per_revolution) noexcept;

}  // namespace kerf::drilling
