// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

/// Outlines of projected points, in the plane of the projection.
namespace kerf {

struct PlanePoint {
    double along = 0.0, out = 0.0;  ///< [m]
};

/// Returns the indices of the points on the outer side of the convex hull, by ascending `along`: what a ruler that
/// comes from +out can touch. Points between two others on one line are left out.   [any] pure.
[[nodiscard]] std::vector<std::size_t> outer_hull(std::span<const PlanePoint> points);

/// Two contacts of a ruler with points, as indices.
struct Contacts {
    std::size_t first = 0, last = 0;
};
/// Returns where a ruler touches that is pressed against the points from +out at `middle`: it rests on the edge of
/// the hull across `middle`. Points that are closer to it than `play` [m] count as touching, and the outermost of
/// those are returned. Nothing where the points do not reach to both sides of `middle`.   [any] pure.
[[nodiscard]] std::optional<Contacts> contacts_of_ruler(std::span<const PlanePoint> points, double middle, double play);

}  // namespace kerf
