// SPDX-License-Identifier: Apache-2.0
#include "bit_bending.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kerf/units.hpp"

namespace kerf::drilling {

namespace {

/// What a channel does to the bit: forces across it and moments about the tip, as if they pushed at one height.
struct Load {
    double fx = 0.0, fy = 0.0, mx = 0.0, my = 0.0;  ///< [N], [N·m]
    double z = 0.0;                                 ///< [m]

    [[nodiscard]] bool bends() const noexcept { return fx != 0.0 || fy != 0.0 || mx != 0.0 || my != 0.0; }
};

Load load_of(const kerf_channel& channel, double lambda, double length) noexcept {
    const auto on_bit = [&](std::size_t i) { return lambda * (channel.follow[i] - channel.d[i]); };
    Load load{on_bit(0), on_bit(1), on_bit(3), on_bit(4)};
    const double squared = load.fx * load.fx + load.fy * load.fy;
    if (squared > 0.0) load.z = std::clamp((load.my * load.fx - load.mx * load.fy) / squared, -length, 0.0);
    return load;
}

}  // namespace

double bending_stress(const TwistDrill& drill, const Advance& advance) noexcept {
    std::array<Load, KERF_MAX_CHANNELS> load;
    std::size_t count = 0;
    for (std::size_t c = 0; c < advance.channel.size() && count < load.size(); ++c) {
        if (advance.lambda[c] == 0.0) continue;
        load[count] = load_of(advance.channel[c], advance.lambda[c], drill.length);
        count += load[count].bends() ? 1 : 0;
    }
    double most2 = 0.0;  // [Pa²]
    const auto look_at = [&](double z) {
        double mx = 0.0, my = 0.0;
        for (std::size_t i = 0; i < count; ++i) {
            if (load[i].z < z) continue;
            mx += load[i].mx + z * load[i].fy;
            my += load[i].my - z * load[i].fx;
        }
        const double d = 2.0 * drill.bit_radius_at(z), per_moment = 64.0 / (pi * d * d * d);
        most2 = std::max(most2, (mx * mx + my * my) * per_moment * per_moment);
    };
    for (std::size_t i = 0; i < count; ++i) look_at(load[i].z);
    if (count > 0) look_at(-drill.length);
    return std::sqrt(most2);
}

}  // namespace kerf::drilling
