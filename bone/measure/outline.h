// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

/// Outlines of projected points, in the plane of the projection.
namespace kerf::bone {

struct PlanePoint {
    double along = 0.0, out = 0.0;  ///< [m]
};

/// Returns the indices of the points on the outer side of the convex hull, by ascending `along`: the points that a
/// ruler from +out can touch. Collinear points between two others are left out.   [any] pure.
[[nodiscard]] std::vector<std::size_t> outer_hull(std::span<const PlanePoint> points);

/// Two contacts of a ruler with points, as indices.
struct Contacts {
    std::size_t first = 0, last = 0;
};
/// Returns the contacts of a ruler that is pressed against the points from +out at `middle`: it rests on the edge of
/// the hull across `middle`. Points closer to it than `play` [m] count as contacts; the outermost of them are returned.
/// Nothing if the points do not reach to both sides of `middle`.   [any] pure.
[[nodiscard]] std::optional<Contacts> contacts_of_ruler(std::span<const PlanePoint> points, double middle, double play);

}  // namespace kerf::bone
