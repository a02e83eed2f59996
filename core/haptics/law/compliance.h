// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Springs in series between a hand and the tip of a tool, in a plane through the shaft.
namespace kerf {

/// Compliance at a point of the tool. A force F across the shaft at the point and a torque τ move it by `shift` F +
/// `mixed` τ. They turn the tool by `mixed` F + `turn` τ. Compliances of springs in series add up.
struct Compliance {
    double shift = 0.0;  ///< [m/N]
    double mixed = 0.0;  ///< [1/N]
    double turn = 0.0;   ///< [rad/(N·m)]
};

[[nodiscard]] constexpr Compliance operator+(Compliance a, Compliance b) noexcept {
    return {a.shift + b.shift, a.mixed + b.mixed, a.turn + b.turn};
}
/// Returns the compliance at a point that lies `ahead` [m] nearer to the tip than the point of `c`.   [any] pure.
[[nodiscard]] constexpr Compliance at_point_ahead(Compliance c, double ahead) noexcept {
    return {c.shift + ahead * (2.0 * c.mixed + ahead * c.turn), c.mixed + ahead * c.turn, c.turn};
}

/// Bending of a shaft, clamped at its end, per newton of a force across its tip.
struct TipBending {
    double deflection = 0.0;  ///< [m/N] of the tip
    double slope = 0.0;       ///< [rad/N] of the tip
};
/// Returns the compliance at the tip of a shaft that always bends in the shape which a force at the tip gives it. The
/// different shape under a torque is neglected.   [any] pure.
[[nodiscard]] constexpr Compliance bending_compliance(TipBending tip) noexcept {
    return {tip.deflection, tip.slope, tip.deflection > 0.0 ? tip.slope * tip.slope / tip.deflection : 0.0};
}

/// A spring across the shaft and a spring in rotation, at the centre of compliance. There, a force does not turn the
/// tool and a torque does not shift it.
struct CentredSpring {
    double ahead = 0.0;  ///< [m] from the compliance's point to the centre; positive towards the tip
    double shift = 0.0;  ///< [N/m]
    double turn = 0.0;   ///< [N·m/rad]
};
/// Returns the springs that have the compliance `c`. Pre: `c` is positive definite.   [any] pure.
[[nodiscard]] constexpr CentredSpring centred(Compliance c) noexcept {
    return {-c.mixed / c.turn, 1.0 / (c.shift - c.mixed * c.mixed / c.turn), 1.0 / c.turn};
}

}  // namespace kerf
