// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "kerf/math.hpp"

namespace kerf::bone {

/// A cone of X-rays from a point to a flat detector. World frame [m].
struct Beam {
    Vec3 source{}, centre{};           ///< focus of the tube; centre of the detector
    Vec3 right{1, 0, 0}, up{0, 0, 1};  ///< unit vectors of the picture in the detector, square to each other
    double width = 0.0;                ///< [m] of the detector along `right`; pixels are square
    int columns = 512, rows = 512;

    [[nodiscard]] double pixel() const noexcept { return width / columns; }  ///< [m]
    /// Returns the middle of a pixel; row 0 is the top.   [any] pure.
    [[nodiscard]] Vec3 pixel_centre(int column, int row) const noexcept {
        return centre + ((column + 0.5 - 0.5 * columns) * pixel()) * right - ((row + 0.5 - 0.5 * rows) * pixel()) * up;
    }
};

/// Size of a C-arm.
struct CArm {
    double source_to_detector = 1.0;  ///< [m] [assumed]
    double source_to_target = 0.65;   ///< [m] [assumed]
    double width = 0.23;              ///< [m] of its detector: an image intensifier of 9 inches
    int pixels = 512;                 ///< along either side
};

/// Returns the beam of a C-arm through a point of the world, which is LPS. Angles [rad]:
///
///     about the head's axis: 0 the source is in front, an AP view; π/2 it is at the patient's left, a lateral view
///     tilt:                  of the source towards the head
///
/// The picture shows the patient from the source, with the head up.   [any] pure.
/// Pre: |angles| ≤ 1e6
[[nodiscard]] Beam beam(Vec3 target, double about_head_axis, double tilt, const CArm& arm = {});

/// Returns why a beam can give no picture: not finite, no width, no pixels, vectors that are no right angle, or its
/// source in the plane of the detector. Empty: it can.   [any] pure.
[[nodiscard]] std::string error_of(const Beam& beam);

}  // namespace kerf::bone
