// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "kerf/exact_math.hpp"
#include "kerf/math.hpp"

/// Geometry of a saw's teeth, and of an oscillating saw's blade: an arc of teeth about the axis of its swing.
namespace kerf::sawing {

inline constexpr std::size_t max_teeth = 64;

/// A tooth. Its forces: against the feed along −normal, against its motion along ∓along, aside along y.
struct Tooth {
    Vec3 tip;     ///< [m] in the middle of its width
    Vec3 normal;  ///< unit, out of the blade, in its plane
    Vec3 along;   ///< unit, direction of motion while the swing grows
    double side;  ///< [–] +1 or −1: side of its set
};
struct Teeth {
    std::array<Tooth, max_teeth> tooth;
    std::size_t count = 0;
};
/// A point of the line through the tips.
struct FrontPoint {
    Vec3 at;      ///< [m]
    Vec3 normal;  ///< unit, out of the blade, in its plane
};

/// Tool frame: origin at the tip, in the middle of the front; +z out of the tip, x along the motion of the teeth, y
/// across the blade.
struct SawBlade {
    double radius;        ///< [m] from the axis of the swing to the tips
    double arc;           ///< [rad] of the swing, from one turning point to the other
    double pitch;         ///< [m] from tip to tip along the arc
    double tooth_count;   ///< [–] a whole number
    double thickness;     ///< [m] of the blade
    double set;           ///< [m] protrusion of the teeth, on alternate sides
    double tooth_height;  ///< [m] from tip to root, the cutting depth of the front

    [[nodiscard]] double kerf() const noexcept { return thickness + 2.0 * set; }  ///< [m]
    [[nodiscard]] double stroke() const noexcept { return radius * arc; }         ///< S [m] along the arc
    [[nodiscard]] std::size_t count() const noexcept { return static_cast<std::size_t>(tooth_count); }
    /// [rad] half angle of the front at rest, and of the whole sweep of the swing.
    [[nodiscard]] double half_front() const noexcept { return 0.5 * tooth_count * pitch / radius; }
    [[nodiscard]] double half_sweep() const noexcept { return half_front() + 0.5 * arc; }
    [[nodiscard]] double amplitude() const noexcept { return 0.5 * arc; }  ///< [rad] of the swing
    /// Returns the point of the front at `angle` [rad] from the middle.
    [[nodiscard]] Vec3 on_front(SinCos angle) const noexcept {
        return {radius * angle.sin, 0.0, radius * (angle.cos - 1.0)};
    }
    /// Returns the point of the front at a fraction of its length, −1 … 1 from end to end.
    [[nodiscard]] FrontPoint front(double fraction) const noexcept {
        const SinCos angle = sin_cos_exact(fraction * half_front());
        return {on_front(angle), {angle.sin, 0.0, angle.cos}};
    }
    /// Returns the end of the front's sweep on the +x side.
    [[nodiscard]] Vec3 end_of_sweep() const noexcept { return on_front(sin_cos_exact(half_sweep())); }
    /// Returns the points on the front at `distance` [m] to either side of a tooth's tip.
    [[nodiscard]] std::array<Vec3, 2> points_around(const Tooth& tooth, double distance) const noexcept {
        const SinCos angle = sin_cos_exact(distance / radius);
        const Vec3 middle = Vec3{0, 0, -radius} + (radius * angle.cos) * tooth.normal + Vec3{0, tooth.tip.y, 0},
                   aside = (radius * angle.sin) * tooth.along;
        return {middle - aside, middle + aside};
    }
};
/// Returns all teeth of a blade swung by `swing` [rad].   [any] pure.
[[nodiscard]] Teeth teeth_of(const SawBlade& blade, double swing) noexcept;

}  // namespace kerf::sawing
