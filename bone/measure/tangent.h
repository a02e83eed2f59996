// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "bone/measure/line.h"
#include "bone/measure/path.h"
#include "bone/measure/surface.h"

namespace kerf {

/// How a border is looked at.
struct BorderView {
    Vec3 normal{};  ///< unit, of the plane of projection
    Vec3 side{};    ///< unit, roughly out of the bone at the border
};

/// The tangent of a bone's border as a projection shows it, such as the lower border of a mandible from the side.
struct Tangent {
    Line line{};           ///< in the plane of projection through its first contact, from the path's first point on
    Vec3 out{};            ///< unit, in the plane of projection, across the line and out of the bone
    Vec3 first{}, last{};  ///< [m] points of the surface that touch it
    [[nodiscard]] Plane plane() const noexcept { return {line.point, out}; }  ///< along the view
};

/// Returns the tangent of the surface points within a path: the supporting line of their projection that a ruler has
/// when it is pressed against the border at the middle of the path, from `side`.
///
/// The ruler touches at two points: the corners of the convex hull to either side of the middle, or the outermost ones
/// that are within `play` of it. So a notch between gonion and chin is bridged, as on a lateral cephalogram, and bone
/// that is cut away lets the ruler sink to what is left. Nothing where no surface is on both sides of the middle, or
/// where `side` leads along the path.   [any] pure.
/// @param points    #N points of the surface [m]; those outside the path are ignored
/// @param play      [m] by which points may be under the ruler and still count as contacts
/// @param shifts    [m] by which the two contacts are moved outwards, for the propagation of their uncertainty
[[nodiscard]] std::optional<Tangent> tangent_of(std::span<const Vec3> points, const Path& path, const BorderView& view,
                                                double play, std::span<const double, 2> shifts);
[[nodiscard]] std::optional<Tangent> tangent_of(std::span<const Vec3> points, const Path& path, const BorderView& view,
                                                double play = 0.0);

/// Returns the standard uncertainty of a tangent's direction [rad] that two contacts give it, each known to
/// `contact` [m] across the line.
///
///     u = √2 · contact / distance of the contacts along the line
///
/// In closed form, by [gum-2008], 5.1.2.   [any] pure.
[[nodiscard]] double direction_uncertainty(const Tangent& tangent, double contact) noexcept;

}  // namespace kerf
