// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/math.hpp"

namespace kerf {

/// What of a tool and its handpiece resists being moved faster across its axis: without it a force that turns with the
/// spindle throws the tool across its play in one tick.
///
/// Along the axis, and about it, a tool has no mass: behind a shell its force is to end within ticks (resolutions R5),
/// and half a kilogram swings on the coupling instead.
struct Inertia {
    double mass = 0.0;      ///< [kg]
    double centre_z = 0.0;  ///< [m] of the mass, on the axis
    double gyration = 0.0;  ///< [m] radius of gyration about that centre, about every line across the axis
};

/// Across the axis, about the tip [kg·m/s, kg·m²/s], at a rate of the tip, tool frame.   [any] pure, nonblocking.
[[nodiscard]] constexpr Vec6 momentum(const Inertia& of, const Vec6& rate) noexcept {
    const double px = of.mass * (rate[0] + of.centre_z * rate[4]), py = of.mass * (rate[1] - of.centre_z * rate[3]);
    const double turning = of.mass * of.gyration * of.gyration;
    return {px, py, 0.0, turning * rate[3] - of.centre_z * py, turning * rate[4] + of.centre_z * px, 0.0};
}
/// [J]
[[nodiscard]] constexpr double kinetic_energy(const Inertia& of, const Vec6& rate) noexcept {
    return 0.5 * dot(momentum(of, rate), rate);
}

}  // namespace kerf
