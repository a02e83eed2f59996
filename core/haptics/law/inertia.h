// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/math.hpp"

namespace kerf {

/// Inertia of a tool with its handpiece, across its axis. Without it, a force that rotates with the spindle would move
/// the tool across its play in one tick.
///
/// The tool has no mass along its axis and no inertia in rotation about it. After a breakthrough the axial force must
/// vanish within a few ticks, but a mass of 0.5 kg would swing on the coupling.
struct Inertia {
    double mass = 0.0;      ///< [kg]
    double centre_z = 0.0;  ///< [m] centre of mass, on the axis, tool frame
    double gyration = 0.0;  ///< [m] radius of gyration about that centre, for every line across the axis
};

/// Returns the momentum and the angular momentum about the tip [kg·m/s, kg·m²/s] at a rate of the tool about its tip.
/// Both are in the tool frame. The components along the axis are 0.   [any] pure, nonblocking.
[[nodiscard]] constexpr Vec6 momentum(const Inertia& of, const Vec6& rate) noexcept {
    const double px = of.mass * (rate[0] + of.centre_z * rate[4]), py = of.mass * (rate[1] - of.centre_z * rate[3]);
    const double turning = of.mass * of.gyration * of.gyration;
    return {px, py, 0.0, turning * rate[3] - of.centre_z * py, turning * rate[4] + of.centre_z * px, 0.0};
}
/// Returns the kinetic energy [J] at a rate of the tool about its tip, tool frame.   [any] pure, nonblocking.
[[nodiscard]] constexpr double kinetic_energy(const Inertia& of, const Vec6& rate) noexcept {
    return 0.5 * dot(momentum(of, rate), rate);
}

}  // namespace kerf
