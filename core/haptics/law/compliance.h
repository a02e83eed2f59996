// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Springs in series between a hand and the tip of a tool, in a plane through the shaft.
namespace kerf {

/// What a force F across the shaft and a torque τ do to a point on it: it moves by `shift` F + `mixed` τ, and the tool
/// turns by `mixed` F + `turn` τ. Of springs in series these add up.
struct Compliance {
    double shift = 0.0;  ///< [m/N]
    double mixed = 0.0;  ///< [1/N]
    double turn = 0.0;   ///< [rad/(N·m)]
};

[[nodiscard]] constexpr Compliance operator+(Compliance a, Compliance b) noexcept {
    return {a.shift + b.shift, a.mixed + b.mixed, a.turn + b.turn};
}
/// The same at a point `ahead` [m], towards the tip.   [any] pure.
[[nodiscard]] constexpr Compliance seen_ahead(Compliance c, double ahead) noexcept {
    return {c.shift + ahead * (2.0 * c.mixed + ahead * c.turn), c.mixed + ahead * c.turn, c.turn};
}

/// How a shaft held at its end gives way to a force across the tip.
struct TipBending {
    double deflection = 0.0;  ///< [m/N]
    double slope = 0.0;       ///< [rad/N]
};
/// At the tip, in the shape that a force there gives the shaft. A torque's own shape is left out.   [any] pure.
[[nodiscard]] constexpr Compliance bent(TipBending tip) noexcept {
    return {tip.deflection, tip.slope, tip.deflection > 0.0 ? tip.slope * tip.slope / tip.deflection : 0.0};
}

/// One spring across the shaft and one that turns, both where a force does not turn the tool, nor a torque shift it.
struct CentredSpring {
    double ahead = 0.0;  ///< [m] of the point that the compliance was seen at
    double shift = 0.0;  ///< [N/m]
    double turn = 0.0;   ///< [N·m/rad]
};
/// Pre: `c` is positive definite.   [any] pure.
[[nodiscard]] constexpr CentredSpring centred(Compliance c) noexcept {
    return {-c.mixed / c.turn, 1.0 / (c.shift - c.mixed * c.mixed / c.turn), 1.0 / c.turn};
}

}  // namespace kerf
