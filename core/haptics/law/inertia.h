// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/math.hpp"

namespace kerf {

/// Inertia of a tool with its handpiece, across its axis. Without it, a force that rotates with the spindle throws the
/// tool across its play in one tick.
///
/// The tool has no mass along its axis or in rotation about it. Behind a shell of bone the axial force must vanish
/// within ticks, but half a kilogram would swing on the coupling.
struct Inertia {
    double mass = 0.0;      ///< [kg]
    double centre_z = 0.0;  ///< [m] centre of mass, on the axis, tool frame
    double gyration = 0.0;  ///< [m] radius of gyration about that centre, for every line across the axis
};

/// Returns the momentum across the axis, about the tip [kg·m/s, kg·m²/s], at a rate of the tip, tool frame.
/// [any] pure, nonblocking.
[[nodiscard]] constexpr Vec6 momentum(const Inertia& of, const Vec6& rate) noexcept {
    const double px = of.mass * (rate[0] + of.centre_z * rate[4]), py = of.mass * (rate[1] - of.centre_z * rate[3]);
    const double turning = of.mass * of.gyration * of.gyration;
    return {px, py, 0.0, turning * rate[3] - of.centre_z * py, turning * rate[4] + of.centre_z * px, 0.0};
}
/// Returns the kinetic energy [J] at a rate of the tip.   [any] pure, nonblocking.
[[nodiscard]] constexpr double kinetic_energy(const Inertia& of, const Vec6& rate) noexcept {
    return 0.5 * dot(momentum(of, rate), rate);
}

}  // namespace kerf
