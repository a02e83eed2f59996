// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/exact_math.hpp"
#include "kerf/math.hpp"
#include "kerf/outline.hpp"
#include "kerf/sampled_wall.hpp"

/// Geometry of a burr's head: a solid of revolution with blades on its whole surface.
namespace kerf::burring {

/// A point of the head's meridian with its unit normal, in the half plane (radius, z).
struct MeridianPoint {
    double radius, z;           ///< [m]
    double normal_r, normal_z;  ///< [–] outwards
    double arc_radius;          ///< [m] of the meridian at the point; 0: straight

    /// Returns how far inside its true position the wall may lie that the head has cut [m], if samples are `voxel` [m]
    /// apart. It adds the errors of the meridian's curve and of the curve around the axis, which are equal on the axis.
    [[nodiscard]] double sagitta(double voxel) const noexcept {
        const double along = arc_radius > 0.0 ? wall_sagitta(arc_radius, voxel) : 0.0;
        return along + (normal_r > 0.0 && radius > 0.0 ? wall_sagitta(radius / normal_r, voxel) : along);
    }
};

/// The meridian: a flat end, an arc, a straight side. Tool frame: origin at the tip, +z out of the tip.
///
///     round        no flat end, an arc of the ball's radius up to the neck, no side
///     cylindrical  a flat end, a small arc as its corner, a side along the axis
///     pear         no flat end, an arc of the ball's radius past its equator, a side that narrows towards the neck
struct BurrHead {
    double end_radius = 0.0;   ///< [m] of the flat end
    double arc_radius = 0.0;   ///< [m] > 0
    double arc_angle = 0.0;    ///< [rad] of the arc, from the axis
    double side_length = 0.0;  ///< [m] of the side, along it
    double neck_radius = 0.0;  ///< [m] of the shaft behind the head
    double blades = 1.0;       ///< [–] a whole number; each runs along the whole meridian

    /// Returns the length of a blade from the axis to the head's end [m].
    [[nodiscard]] double meridian() const noexcept { return end_radius + arc_radius * arc_angle + side_length; }
    /// Returns the point at the length `along` [m] of the meridian.   [any] pure.
    [[nodiscard]] MeridianPoint at(double along) const noexcept;
    [[nodiscard]] double end_z() const noexcept { return at(meridian()).z; }  ///< [m] end of the head, < 0
    [[nodiscard]] double widest_radius() const noexcept;                      ///< [m]
    /// Returns the outline of head and neck up to `length` [m] behind the tip. The head removes bone.   [main] pure.
    [[nodiscard]] Outline outline(double length) const noexcept;
};

}  // namespace kerf::burring
