// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

#include "documents/made/dimension.h"
#include "kerf/math.hpp"

namespace kerf::documents {

/// The directions of the borders of an angle, seen from the side. They meet at the origin.
struct MandibleFrame {
    double rise = 0.0;      ///< [rad] of the posterior border above the horizontal
    double fall = 0.0;      ///< [rad] of the lower border below it, towards the chin
    Vec3 up{}, behind{};    ///< along the posterior border, and out of it
    Vec3 ahead{}, above{};  ///< along the lower border to the chin, and from it into the bone

    explicit MandibleFrame(double gonial_angle, double mandibular_plane)
        : rise(std::numbers::pi + mandibular_plane - gonial_angle),
          fall(mandibular_plane),
          up{0, std::cos(rise), std::sin(rise)},
          behind{0, std::sin(rise), -std::cos(rise)},
          ahead{0, -std::cos(fall), -std::sin(fall)},
          above{0, -std::sin(fall), std::cos(fall)} {}
    explicit MandibleFrame(const DimensionValues& v) : MandibleFrame(v["gonial.angle"], v["mandibular_plane.angle"]) {}

    /// Returns a point at a height along the posterior border, and at a depth in front of it.
    [[nodiscard]] Vec3 in_ramus(double x, double height, double depth) const {
        return Vec3{x, 0, 0} + height * up - depth * behind;
    }
    /// Returns a point at a distance in front of the corner, and at a height above the lower border.
    [[nodiscard]] Vec3 in_body(double x, double distance, double height) const {
        return Vec3{x, 0, 0} + distance * ahead + height * above;
    }
};

}  // namespace kerf::documents
