// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "kerf/math.hpp"

/// Closed curves across the path of a loft. Points [m] lie in the plane z = 0 and run anticlockwise; the last is joined
/// to the first.
namespace kerf::documents {

using Outline = std::vector<Vec3>;

/// Returns a smooth curve through the points: six straight pieces from each to the next, along a cubic whose slopes are
/// those of the chords between neighbours (Catmull and Rom).   [any] pure
[[nodiscard]] Outline smoothed(const Outline& points);

/// Returns the enclosed area [m²]; negative if the points run clockwise.   [any] pure
[[nodiscard]] double area_of(const Outline& outline) noexcept;

/// Returns whether two of its pieces meet, other than neighbours.   [any] pure
[[nodiscard]] bool crosses_itself(const Outline& outline) noexcept;

/// Returns the radius of its sharpest corner that points outwards [m]; +infinity if there is none.   [any] pure
[[nodiscard]] double sharpest_radius(const Outline& outline) noexcept;

/// The point of an outline that is nearest to a point.
struct NearestOnOutline {
    double distance = 0.0;  ///< [m] signed, negative inside
    double leaning = 0.0;   ///< [–] how fast the curve moves outwards along the path there
};

/// Returns the nearest point of the curve between two outlines: at `t` from 0 to 1, `apart` [m] from each other along
/// the path.   Pre: both have as many points.   [any] pure
[[nodiscard]] NearestOnOutline nearest_between(const Outline& a, const Outline& b, double t, double apart,
                                               Vec3 p) noexcept;

}  // namespace kerf::documents
