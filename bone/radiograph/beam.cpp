// SPDX-License-Identifier: Apache-2.0
#include "bone/radiograph/beam.h"

#include <cmath>

#include "kerf/exact_math.hpp"

namespace kerf::bone {

Beam beam(Vec3 target, double about_head_axis, double tilt, const CArm& arm) {
    const SinCos about = sin_cos_exact(about_head_axis), tilted = sin_cos_exact(tilt);
    const Vec3 to_source{tilted.cos * about.sin, -tilted.cos * about.cos, tilted.sin};
    const Vec3 up{-tilted.sin * about.sin, tilted.sin * about.cos, tilted.cos};
    Beam b;
    b.source = target + arm.source_to_target * to_source;
    b.centre = target - (arm.source_to_detector - arm.source_to_target) * to_source;
    b.right = cross(up, to_source);
    b.up = up;
    b.width = arm.width;
    b.columns = b.rows = arm.pixels;
    return b;
}

std::string error_of(const Beam& beam) {
    constexpr double small = 1e-3;
    if (!is_finite(beam.source) || !is_finite(beam.centre) || !is_finite(beam.right) || !is_finite(beam.up) ||
        !std::isfinite(beam.width))
        return "The beam has a coordinate that is not finite.";
    if (beam.columns < 1 || beam.rows < 1 || beam.columns > 4096 || beam.rows > 4096)
        return "The detector has " + std::to_string(beam.columns) + " x " + std::to_string(beam.rows) +
               " pixels; expected 1 to 4096 along each side.";
    if (!(beam.width >= 1e-3 && beam.width <= 10.0)) return "The detector's width is not 1 mm to 10 m.";
    if (std::abs(length(beam.right) - 1.0) > small || std::abs(length(beam.up) - 1.0) > small ||
        std::abs(dot(beam.right, beam.up)) > small)
        return "The picture's axes are not two unit vectors at a right angle.";
    if (!(std::abs(dot(beam.centre - beam.source, cross(beam.right, beam.up))) >= 10e-3))
        return "The source is less than 10 mm from the plane of the detector.";
    return {};
}

}  // namespace kerf::bone
