// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "kerf/exact_math.hpp"
#include "kerf/math.hpp"

/// The geometry of a twist drill: its outline, its two lips and its chisel edge.
namespace kerf::drilling {

inline constexpr int lip_count = 2;

/// A cone that its lips sweep.
struct Cone {
    SinCos half_angle;
    double inner, outer;  ///< [m] radii where it begins and ends
    double z;             ///< [m] where it begins

    [[nodiscard]] double z_at(double radius) const noexcept { return z - (radius - inner) * half_angle.cos / half_angle.sin; }
    [[nodiscard]] double end() const noexcept { return z_at(outer); }
};

/// What a twist drill is made of. Tool frame: origin at the tip, +z out of the tip.
struct TwistDrill {
    double diameter;     ///< [m]
    double point_angle;  ///< [rad] full
    double web;          ///< [–] web thickness over diameter
    double length;       ///< [m] tip to chuck
    double corner;       ///< [–] length behind a corner that still cuts sideways, over diameter
    double shoulder_diameter = 0.0;  ///< [m] of a wider part behind the point; 0: none
    double shoulder_angle = 0.0;     ///< [rad] full: 90° a countersink, a few degrees a taper
    double shoulder_depth = 0.0;     ///< [m] from the tip to where it begins
    double runout = 0.0;       ///< [m] how far the tip runs off the axis it turns about, towards the first lip
    double helix_angle = 28.0 * 3.14159265358979323846 / 180.0;  ///< [rad] of the flutes at the diameter
    SinCos half_point = sin_cos_exact(0.5 * point_angle);  ///< of the point's half angle p: asked for often, worked out once

    [[nodiscard]] double radius() const noexcept { return 0.5 * diameter; }
    [[nodiscard]] double half_web() const noexcept { return 0.5 * web * diameter; }
    /// Where the chisel edge ends and the lips begin [m]: half web over sin 55° (chisel angle 125°, standard grind).
    [[nodiscard]] double chisel_radius() const noexcept { return half_web() / 0.81915204428899180; }
    /// Depth of the point: R cot p [m].
    [[nodiscard]] double point_depth() const noexcept { return radius() * half_point.cos / half_point.sin; }
    [[nodiscard]] bool has_shoulder() const noexcept { return shoulder_diameter > diameter; }
    [[nodiscard]] double widest_radius() const noexcept { return has_shoulder() ? 0.5 * shoulder_diameter : radius(); }
    /// The point, and the shoulder behind it where there is one.
    struct Cones {
        std::array<Cone, 2> cone;
        std::size_t count = 0;
        [[nodiscard]] const Cone* begin() const noexcept { return cone.data(); }
        [[nodiscard]] const Cone* end() const noexcept { return cone.data() + count; }
        [[nodiscard]] const Cone& last() const noexcept { return cone[count - 1]; }
    };
    [[nodiscard]] Cones cones() const noexcept;
    /// [m] behind a cone that cuts sideways. From there on it only touches.
    [[nodiscard]] double land() const noexcept { return corner * diameter; }
    /// [m] between the point and the shoulder; 0 where there is none.
    [[nodiscard]] double pilot() const noexcept { return has_shoulder() ? shoulder_depth - point_depth() : 0.0; }
    /// How far the second lip stays behind the first one's cut, along the shaft: 2 e cot p [m].
    [[nodiscard]] double lag_of_second_lip() const noexcept { return 2.0 * runout * half_point.cos / half_point.sin; }
    /// Rake of the lips at `radius` [rad] with flutes of this helix: tan γ = (r/R) tan(helix), to within 0.3°; the web's share is left out.
    [[nodiscard]] double rake_at(double radius, SinCos helix) const noexcept;
};

/// A short piece of one lip. Cylindrical frame at its place: r̂ outwards, ẑ out of the tip, t̂ = ẑ × r̂ the way it runs.
struct LipElement {
    double radius;         ///< [m]
    double along;          ///< [m] from the point next to the axis, along the lip's projection
    double z;              ///< [m]
    double width;          ///< [m] of cut, across the cutting velocity
    double normal_axial;   ///< [–] n̂·ẑ, n̂ the unit normal of the cut surface, into the bone
    double normal_radial;  ///< [–] n̂·r̂
};

inline constexpr std::size_t largest_element_count = 160;

/// One lip, from the chisel edge to the corner, and on along the shoulder.
struct Lip {
    std::array<LipElement, largest_element_count> element;
    std::size_t count = 0;
};

/// Cuts the lip, and the shoulder's if there is one, into pieces of at most `pitch` [m] along their projection, at most
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
