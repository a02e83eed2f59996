// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/math.hpp"

namespace kerf {

/// What of a tool and its handpiece resists being moved faster. Without mass a force that turns with the drill would throw the tool
/// across its play in one tick.
struct Inertia {
    double mass = 0.0;      ///< [kg]
    double centre_z = 0.0;  ///< [m] of the mass, on the tool's axis
    double gyration = 0.0;  ///< [m] its radius of gyration about that centre, about every axis the same
};

/// About the tip [kg·m/s, kg·m²/s], at a rate of the tip, tool frame.   [any] pure, nonblocking.
[[nodiscard]] constexpr Vec6 momentum(const Inertia& of, const Vec6& rate) noexcept {
    const Vec3 centre{0, 0, of.centre_z}, turn = angular(rate);
    const Vec3 p = of.mass * (linear(rate) + cross(turn, centre));
    return make_vec6(p, cross(centre, p) + of.mass * of.gyration * of.gyration * turn);
}
/// [J]
[[nodiscard]] constexpr double kinetic_energy(const Inertia& of, const Vec6& rate) noexcept { return 0.5 * dot(momentum(of, rate), rate); }

}  // namespace kerf
