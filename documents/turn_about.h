// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "kerf/math.hpp"

namespace kerf::documents {

/// Returns the rotation about unit `axis` from unit `from` to unit `to`, which are both across it.   [any] pure.
[[nodiscard]] inline Quat turn_about(Vec3 axis, Vec3 from, Vec3 to) noexcept {
    const double cosine = dot(from, to), sine = dot(cross(from, to), axis);
    // Of the two half angles the one that cannot vanish.
    double half_cosine, half_sine;
    if (cosine >= 0.0) {
        half_cosine = std::sqrt(0.5 * (1.0 + cosine));
        half_sine = 0.5 * sine / half_cosine;
    } else {
        half_sine = std::sqrt(0.5 * (1.0 - cosine));
        half_cosine = 0.5 * sine / half_sine;
    }
    return normalized(Quat{half_cosine, half_sine * axis.x, half_sine * axis.y, half_sine * axis.z});
}

}  // namespace kerf::documents
