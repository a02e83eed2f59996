// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "kerf/math.hpp"

namespace kerf::implant {

/// How much of its strength a thread in bone has left after it slipped by `q` [m].
///
///     h(q) = y + (1 − y) q/q_m   up to q_m, the largest; then 1 − (q − q_m)/q_s, never below 0
///
/// with y = yield_share, q_m = yield_slip, q_s = strip_slip. Stripping depends on slip alone, neither on time nor on
/// ticks.   [any] pure.   Source: docs/models/screw.md.
[[nodiscard]] inline double strength_left(double q, double yield_share, double yield_slip, double strip_slip) noexcept {
    if (q <= yield_slip) return yield_share + (1.0 - yield_share) * std::max(q, 0.0) / yield_slip;
    return std::max(0.0, 1.0 - (q - yield_slip) / strip_slip);
}

/// Where a screw that has left bone is, beside the hole that it left.
struct BesideHole {
    double x = 0.0, y = 0.0;              ///< [m] of its tip, across
    double about_x = 0.0, about_y = 0.0;  ///< [rad]

    void move(const Vec6& rate, double dt) noexcept {
        x += rate[0] * dt;
        y += rate[1] * dt;
        about_x += rate[3] * dt;
        about_y += rate[4] * dt;
    }
    /// Whether it would go into other bone than before.
    [[nodiscard]] bool is_elsewhere(double radius) const noexcept {
        constexpr double tilted = 0.2;  // [rad] [judgement]
        return x * x + y * y > radius * radius || about_x * about_x + about_y * about_y > tilted * tilted;
    }
};

/// A thread's grip on bone along its helix: elastic up to its strength, then plastic.
struct ThreadGrip {
    double stretch = 0.0;  ///< [m] elastic, of the screw against bone along the shaft
    double slip = 0.0;     ///< [m] plastic, ≥ 0, of either way

    /// Takes a motion of `by` [m] against the helix; beyond `strength`/`stiffness` it slips.
    void move(double by, double stiffness, double strength) noexcept {
        stretch += by;
        const double most = stiffness > 0.0 ? strength / stiffness : 0.0;
        const double held = std::clamp(stretch, -most, most);
        slip += std::abs(stretch - held);
        stretch = held;
    }
    /// The screw has left the bone that it slipped in.
    void let_go() noexcept { *this = {}; }
};

}  // namespace kerf::implant
