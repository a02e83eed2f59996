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

/// The four ways across the shaft.
inline constexpr Vec3 ways_across[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};

/// How many rings of places each of so many cones gets, where there is room for so many together: no more than `most`.
[[nodiscard]] constexpr std::size_t rings_on_each(std::size_t cones, std::size_t room, std::size_t most) noexcept {
    return std::clamp<std::size_t>(room / cones, 1, most);
}

/// A cone that its lips sweep.
struct Cone {
    SinCos half_angle;
    double inner, outer;  ///< [m] radii where it begins and ends
    double z;             ///< [m] where it begins
    double straight =
        0.0;  ///< [m] how far the outline behind it goes on as wide as it ends; of the last cone nothing is said
    double wall = outer;  ///< [m] radius of the first wall behind it: where another cone follows at once, that one's

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

/// What a drill with two lips is made of. Tool frame: origin at the tip, +z out of the tip.
struct TwistDrill {
    static constexpr std::size_t most_corners = 8;
    static constexpr std::size_t most_lands =
        most_corners / 2 + 1;  ///< one behind each cone that a wall follows, and behind the last

    double diameter;      ///< [m]
    double point_angle;   ///< [rad] full
    double web;           ///< [–] web thickness over diameter
    double length;        ///< [m] tip to chuck
    double corner;        ///< [–] length behind a corner that still cuts sideways, over diameter
    double runout = 0.0;  ///< [m] how far the tip runs off the axis it turns about, towards the first lip
    double helix_angle = 28.0 * 3.14159265358979323846 / 180.0;  ///< [rad] of the flutes at the diameter
    std::array<OutlineCorner, most_corners> corners =
        {};  ///< behind the point, backwards; no radius is less than the one before
    std::size_t corner_count = 0;
    double shank_diameter = 0.0;  ///< [m] behind the head, where it is thinner; 0: as wide
    SinCos half_point =
        sin_cos_exact(0.5 * point_angle);  ///< of the point's half angle p: asked for often, worked out once

    [[nodiscard]] double radius() const noexcept { return 0.5 * diameter; }
    [[nodiscard]] double half_web() const noexcept { return 0.5 * web * diameter; }
    /// Where the chisel edge ends and the lips begin [m]: half web over sin 55° (chisel angle 125°, standard grind).
    [[nodiscard]] double chisel_radius() const noexcept { return half_web() / 0.81915204428899180; }
    /// Depth of the point: R cot p [m].
    [[nodiscard]] double point_depth() const noexcept { return radius() * half_point.cos / half_point.sin; }
    [[nodiscard]] double widest_radius() const noexcept {
        return corner_count > 0 ? corners[corner_count - 1].radius : radius();
    }
    /// Radius of the bit at `z` [m] as it bends: a cone counts as wide as it ends, what is wider than the shank as the
    /// shank.
    [[nodiscard]] double bit_radius_at(double z) const noexcept;
    [[nodiscard]] double shank_radius() const noexcept {
        return shank_diameter > 0.0 ? std::min(0.5 * shank_diameter, widest_radius()) : widest_radius();
    }
    /// The point, and what widens behind it.
    struct Cones {
        std::array<Cone, most_corners + 1> cone;
        std::size_t count = 0;
        [[nodiscard]] const Cone* begin() const noexcept { return cone.data(); }
        [[nodiscard]] const Cone* end() const noexcept { return cone.data() + count; }
        [[nodiscard]] const Cone& last() const noexcept { return cone[count - 1]; }
    };
    [[nodiscard]] Cones cones() const noexcept;
    /// [m] behind a cone that cuts sideways. From there on it only touches.
    [[nodiscard]] double land() const noexcept { return corner * diameter; }
    /// Where the widest part and the land behind it have ended [m].
    [[nodiscard]] double head() const noexcept;
    /// How far the second lip stays behind the first one's cut, along the shaft: 2 e cot p [m].
    [[nodiscard]] double lag_of_second_lip() const noexcept { return 2.0 * runout * half_point.cos / half_point.sin; }
    /// Rake of the lips at `radius` [rad] with flutes of this helix: tan γ = (r/R) tan(helix), to within 0.3°; the
    /// web's share is left out.
    [[nodiscard]] double rake_at(double radius, SinCos helix) const noexcept;
};

/// A short piece of one lip. Cylindrical frame at its place: r̂ outwards, ẑ out of the tip, t̂ = ẑ × r̂ the way it runs.
struct LipElement {
    double radius;         ///< [m]
    double along;          ///< [m] from the point next to the axis, along the lip's projection
    double z;              ///< [m]
    double wall;           ///< [m] radius of the wall of its hole that the end of its cone runs along
    double width;          ///< [m] of cut, across the cutting velocity
    double normal_axial;   ///< [–] n̂·ẑ, n̂ the unit normal of the cut surface, into the bone
    double normal_radial;  ///< [–] n̂·r̂
};

inline constexpr std::size_t largest_element_count = 160;

/// One lip, from the chisel edge to the corner, and on along every cone behind it.
struct Lip {
    std::array<LipElement, largest_element_count> element;
    std::size_t count = 0;
};

/// Cuts the lip, on all of its cones, into pieces of at most `pitch` [m] along their projection, at most
/// `largest_element_count`.
///
/// The lip lies at the half web b from the axis. At radius r it leans by β with sin β = b/r, so the normal of the
/// surface it cuts is
///
///     n̂ = (cos p r̂ + sin p cos β ẑ) / cos i,    cos² i = cos² p + sin² p cos² β
///
/// a unit vector: forces keep their length, unlike those of [tsai-2007] as printed (its rows have length cos i).
/// The width of cut is dℓ cos i, dℓ = ds / sin p; hence width × chip thickness = (f/2) dr exactly.   [any] pure.
///
/// Source: geometry of [tsai-2007]; normalisation ours, docs/models/drilling.md.
[[nodiscard]] Lip make_lip(const TwistDrill& drill, double pitch) noexcept;

/// Where an element of lip `k` is at spindle angle (sin, cos) = `angle`, tool frame [m].   [any] pure.
[[nodiscard]] Vec3 place_of(const LipElement& element, double half_web, double cos_angle, double sin_angle) noexcept;

}  // namespace kerf::drilling
