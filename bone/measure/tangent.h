// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "bone/measure/line.h"
#include "bone/measure/path.h"
#include "bone/measure/surface.h"

namespace kerf::bone {

/// View of a border.
struct BorderView {
    Vec3 normal{};  ///< unit, of the plane of projection
    Vec3 side{};    ///< unit, roughly out of the bone at the border
};

/// The tangent of a bone's border in a projection, such as the lower border of a mandible from the side.
struct Tangent {
    Line line{};           ///< in the plane of projection through its first contact, directed from the path's first
                           ///< point
    Vec3 out{};            ///< unit, in the plane of projection, across the line and out of the bone
    Vec3 first{}, last{};  ///< [m] contact points on the surface
    [[nodiscard]] Plane plane() const noexcept { return {line.point, out}; }  ///< parallel to the view
};

/// Returns the tangent of the surface points within a path: the line of a ruler that is pressed from `side` against
/// their projection, at the middle of the path.
///
/// The ruler touches at two points: the corners of the convex hull to either side of the middle, or the outermost
/// points within `play` of it. So a notch between gonion and chin is bridged, as on a lateral cephalogram. If bone is
/// cut away, the ruler sinks to the remaining bone. Nothing if there is no surface on both sides of the middle, or if
/// `side` is parallel to the path.   [any] pure.
/// @param points  #N points of the surface [m]; points outside the path are ignored
/// @param play    [m] largest distance under the ruler of a contact
/// @param shifts  [m] outward shifts of the two contacts, for the propagation of their uncertainty
[[nodiscard]] std::optional<Tangent> tangent_of(std::span<const Vec3> points, const Path& path, const BorderView& view,
                                                double play, std::span<const double, 2> shifts);
[[nodiscard]] std::optional<Tangent> tangent_of(std::span<const Vec3> points, const Path& path, const BorderView& view,
                                                double play = 0.0);

/// Returns the standard uncertainty of a tangent's direction [rad] from two contacts, each with the uncertainty
/// `contact` [m] across the line.
///
///     u = √2 · contact / distance of the contacts along the line
///
/// In closed form, by [gum-2008], 5.1.2.   [any] pure.
[[nodiscard]] double direction_uncertainty(const Tangent& tangent, double contact) noexcept;

}  // namespace kerf::bone
