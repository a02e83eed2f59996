// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "kerf/exact_math.hpp"
#include "kerf/math.hpp"

/// The geometry of a drill with two lips: its outline, its lips and its chisel edge.
namespace kerf::drilling {

inline constexpr int lip_count = 2;

/// (cos, sin) of eight azimuths about the shaft.
inline constexpr std::size_t azimuth_count = 8;
inline constexpr double cos_45 = 0.70710678118654752440;
inline constexpr double azimuths[azimuth_count][2] = {{1, 0},  {cos_45, cos_45},   {0, 1},  {-cos_45, cos_45},
                                                      {-1, 0}, {-cos_45, -cos_45}, {0, -1}, {cos_45, -cos_45}};

/// The four directions across the shaft.
inline constexpr Vec3 transverse_directions[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};

/// Returns the number of rings on each cone, 1 … `max_rings`, from a total for all cones.
[[nodiscard]] constexpr std::size_t rings_on_each(std::size_t cones, std::size_t total_rings,
                                                  std::size_t max_rings) noexcept {
    return std::clamp<std::size_t>(total_rings / cones, 1, max_rings);
}

/// A cone that the lips sweep.
struct Cone {
    SinCos half_angle;
    double inner, outer;    ///< [m] radii at its front and rear end
    double z;               ///< [m] of its front end
    double straight = 0.0;  ///< [m] length of the cylinder behind it; undefined for the last cone
    double wall = outer;  ///< [m] radius of the next wall behind it; if another cone follows directly, that cone's wall

    [[nodiscard]] double z_at(double radius) const noexcept {
        return z - (radius - inner) * half_angle.cos / half_angle.sin;
    }
    [[nodiscard]] double end() const noexcept { return z_at(outer); }
};

/// A corner of the outline behind the point.
struct OutlineCorner {
    double depth;   ///< [m] from the tip
    double radius;  ///< [m]
};

/// Geometry of a drill with two lips. Tool frame: origin at the tip, +z out of the tip.
struct TwistDrill {
    static constexpr std::size_t max_corners = 8;
    static constexpr std::size_t max_lands =
        max_corners / 2 + 1;  ///< one for each cone that a wall follows, and one behind the last

    double diameter;      ///< [m]
    double point_angle;   ///< [rad] full
    double web;           ///< [–] web thickness over diameter
    double length;        ///< [m] tip to chuck
    double corner;        ///< [–] length over diameter of the land behind a cone, which cuts sideways
    double runout = 0.0;  ///< [m] distance of the tip from the axis of rotation, towards the first lip
    double helix_angle = 28.0 * 3.14159265358979323846 / 180.0;  ///< [rad] of the flutes at the diameter
    std::array<OutlineCorner, max_corners> corners = {};         ///< behind the point, backwards; radii do not decrease
    std::size_t corner_count = 0;
    double shank_diameter = 0.0;  ///< [m] behind the head, if thinner; 0: as wide as the head
    SinCos half_point =
        sin_cos_exact(0.5 * point_angle);  ///< of the half point angle p; stored because many functions need it

    [[nodiscard]] double radius() const noexcept { return 0.5 * diameter; }
    [[nodiscard]] double half_web() const noexcept { return 0.5 * web * diameter; }
    /// Returns the radius [m] where the chisel edge ends: half web over sin 55° (chisel angle 125°, standard grind).
    [[nodiscard]] double chisel_radius() const noexcept { return half_web() / 0.81915204428899180; }
    /// Returns the depth of the point, R cot p [m].
    [[nodiscard]] double point_depth() const noexcept { return radius() * half_point.cos / half_point.sin; }
    [[nodiscard]] double widest_radius() const noexcept {
        return corner_count > 0 ? corners[corner_count - 1].radius : radius();
    }
    /// Returns the radius [m] of the bit at `z` [m] for bending. A cone counts with its widest radius, and the head
    /// with no more than the shank's.
    [[nodiscard]] double bit_radius_at(double z) const noexcept;
    [[nodiscard]] double shank_radius() const noexcept {
        return shank_diameter > 0.0 ? std::min(0.5 * shank_diameter, widest_radius()) : widest_radius();
    }
    /// The cone of the point, and the cones behind it.
    struct Cones {
        std::array<Cone, max_corners + 1> cone;
        std::size_t count = 0;
        [[nodiscard]] const Cone* begin() const noexcept { return cone.data(); }
        [[nodiscard]] const Cone* end() const noexcept { return cone.data() + count; }
        [[nodiscard]] const Cone& last() const noexcept { return cone[count - 1]; }
    };
    [[nodiscard]] Cones cones() const noexcept;
    /// Returns the length [m] behind a cone that cuts sideways. Behind it the drill only touches.
    [[nodiscard]] double land() const noexcept { return corner * diameter; }
    /// Returns the depth [m] at which the widest part and its land end.
    [[nodiscard]] double head() const noexcept;
    /// Returns the lag of the second lip behind the first one's cut, along the shaft: 2 e cot p [m].
    [[nodiscard]] double lag_of_second_lip() const noexcept { return 2.0 * runout * half_point.cos / half_point.sin; }
    /// Returns the rake [rad] of the lips at `radius` [m], for flutes of this helix: tan γ = (r/R) tan(helix), to
    /// within 0.3°. Leaves out the effect of the web.
    [[nodiscard]] double rake_at(double radius, SinCos helix) const noexcept;
};

/// A short piece of one lip. Cylindrical frame at the piece: r̂ outwards, ẑ out of the tip, t̂ = ẑ × r̂ in the
/// direction of cutting.
struct LipElement {
    double radius;         ///< [m]
    double along;          ///< [m] from the point next to the axis, along the lip's projection
    double z;              ///< [m]
    double wall;           ///< [m] radius of the hole's wall at the end of its cone
    double width;          ///< [m] of cut, across the cutting velocity
    double normal_axial;   ///< [–] n̂·ẑ, n̂ the unit normal of the cut surface, into the bone
    double normal_radial;  ///< [–] n̂·r̂
};

inline constexpr std::size_t largest_element_count = 160;

/// One lip, from the chisel edge to the corner and along every cone behind it.
struct Lip {
    std::array<LipElement, largest_element_count> element;
    std::size_t count = 0;
};

/// Returns the lip, on all of its cones, as pieces of at most `pitch` [m] along their projection. Their number is
/// limited to `largest_element_count`.
///
/// The lip lies at the half web b from the axis. At radius r it leans by β with sin β = b/r, so the normal of the
/// surface it cuts is
///
///     n̂ = (cos p r̂ + sin p cos β ẑ) / cos i,    cos² i = cos² p + sin² p cos² β
///
/// This is a unit vector, so forces keep their length. The rows of [tsai-2007] as printed have length cos i. The width
/// of cut is dℓ cos i, dℓ = ds / sin p; hence width × chip thickness = (f/2) dr exactly.   [any] pure.
///
/// Source: geometry of [tsai-2007]; normalisation ours, docs/models/drilling.md.
[[nodiscard]] Lip make_lip(const TwistDrill& drill, double pitch) noexcept;

/// Returns the position [m] of an element at the spindle angle (cos, sin), tool frame.   [any] pure.
[[nodiscard]] Vec3 position_of(const LipElement& element, double half_web, double cos_angle, double sin_angle) noexcept;

}  // namespace kerf::drilling
