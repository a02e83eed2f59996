// SPDX-License-Identifier: Apache-2.0
#include "bit_bending.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "kerf/units.hpp"

namespace kerf::drilling {

namespace {

/// Forces across the bit and moments about its tip. `z` is the one height at which the force gives these moments.
struct Load {
    double fx = 0.0, fy = 0.0, mx = 0.0, my = 0.0;  ///< [N], [N·m]
    double z = 0.0;                                 ///< [m]

    [[nodiscard]] bool bends() const noexcept { return fx != 0.0 || fy != 0.0 || mx != 0.0 || my != 0.0; }
};

/// Returns the load of `wrench` times `times`. Its height is clamped to the bit.
Load load_of(const double* wrench, double times, double length) noexcept {
    Load load{times * wrench[0], times * wrench[1], times * wrench[3], times * wrench[4]};
    const double squared = load.fx * load.fx + load.fy * load.fy;
    if (squared > 0.0) load.z = std::clamp((load.my * load.fx - load.mx * load.fy) / squared, -length, 0.0);
    return load;
}

}  // namespace

Bending bending_of(const TwistDrill& drill, const Advance& advance) noexcept {
    std::array<Load, KERF_MAX_CHANNELS + 1> load;
    std::size_t count = 0;
    const auto add = [&](const double* wrench, double times) {
        if (times == 0.0 || count == load.size()) return;
        load[count] = load_of(wrench, times, drill.length);
        count += load[count].bends() ? 1 : 0;
    };
    add(advance.following.data(), 1.0);
    for (std::size_t c = 0; c < advance.channel.size(); ++c) add(advance.channel[c].d, -advance.lambda[c]);
    Bending strongest;
    double max_squared = 0.0;  // [Pa²]
    const auto evaluate_at = [&](double z) {
        double mx = 0.0, my = 0.0;
        for (std::size_t i = 0; i < count; ++i) {
            if (load[i].z < z) continue;
            mx += load[i].mx + z * load[i].fy;
            my += load[i].my - z * load[i].fx;
        }
        const double d = 2.0 * drill.bit_radius_at(z), per_moment = 64.0 / (pi * d * d * d);
        const double squared = (mx * mx + my * my) * per_moment * per_moment;
        if (squared <= max_squared) return;
        max_squared = squared;
        strongest = {per_moment * mx, per_moment * my};
    };
    for (std::size_t i = 0; i < count; ++i) evaluate_at(load[i].z);
    if (count > 0) evaluate_at(-drill.length);
    return strongest;
}

}  // namespace kerf::drilling
