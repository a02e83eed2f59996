// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "kerf/math.hpp"

/// From the deflection of a cap to a speed, as pure functions. All are odd, continuous and monotone, and keep 0 and ±1.
namespace kerf::run {

/// Returns a deflection [–] without its dead zone [–], which is less than 1: the rest is stretched to the full range.
/// [any] pure.
[[nodiscard]] inline double without_dead_zone(double deflection, double dead_zone) noexcept {
    const double beyond = std::max(0.0, std::min(std::abs(deflection), 1.0) - dead_zone);
    return std::copysign(beyond / (1.0 - dead_zone), deflection);
}

/// Returns the fraction of the full speed for a deflection: its square, so that small deflections are fine. [any] pure.
[[nodiscard]] constexpr double eased(double deflection) noexcept {
    return deflection < 0.0 ? -deflection * deflection : deflection * deflection;
}

/// The response of each axis on its own, so that a hand which leads along one axis does not drift along others.
[[nodiscard]] inline Vec3 response(Vec3 deflection, double dead_zone) noexcept {
    const auto one = [=](double d) { return eased(without_dead_zone(d, dead_zone)); };
    return {one(deflection.x), one(deflection.y), one(deflection.z)};
}

}  // namespace kerf::run
