// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

namespace kerf::implant {

/// Returns the remaining strength of a thread in bone after slip `q` [m], as a fraction [–].
///
///     h(q) = y + (1 − y) q/q_m   up to q_m, the largest; then 1 − (q − q_m)/q_s, never below 0
///
/// with y = yield_share, q_m = yield_slip, q_s = strip_slip. Stripping depends on slip alone, neither on time nor on
/// ticks.   [any] pure. Source: docs/models/screw.md.
[[nodiscard]] inline double strength_left(double q, double yield_share, double yield_slip, double strip_slip) noexcept {
    if (q <= yield_slip) return yield_share + (1.0 - yield_share) * std::max(q, 0.0) / yield_slip;
    return std::max(0.0, 1.0 - (q - yield_slip) / strip_slip);
}

/// Limits the stretch of a spring of `stiffness` [N/m] that yields at `strength` [N]: `stretch` [m] is clamped. Returns
/// the plastic slip [m], ≥ 0.   [any]
inline double yield_plastically(double& stretch, double stiffness, double strength) noexcept {
    const double limit = stiffness > 0.0 ? strength / stiffness : 0.0;
    const double held = std::clamp(stretch, -limit, limit), slip = std::abs(stretch - held);
    stretch = held;
    return slip;
}

}  // namespace kerf::implant
