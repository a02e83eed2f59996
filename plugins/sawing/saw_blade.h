// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "kerf/exact_math.hpp"
#include "kerf/math.hpp"

/// The geometry of a saw's teeth, and of an oscillating saw's blade: an arc of teeth about the axis of its swing.
namespace kerf::sawing {

inline constexpr std::size_t most_teeth = 64;

/// A tooth at its place. Its forces: against the feed along −normal, against its motion along ∓along, aside along y.
struct Tooth {
    Vec3 tip;     ///< [m] in the middle of its width
    Vec3 normal;  ///< unit, out of the blade, in its plane
    Vec3 along;   ///< unit, the way it goes while the swing grows
    double side;  ///< [–] +1 or −1: to which side it is set
};
struct Teeth {
    std::array<Tooth, most_teeth> tooth;
    std::size_t count = 0;
};
/// A point of the line through the tips.
struct FrontPoint {
    Vec3 at;      ///< [m]
    Vec3 normal;  ///< unit, out of the blade, in its plane
};

/// Tool frame: origin at the tip, in the middle of the front; +z out of the tip, x the way the teeth go, y across the
/// blade.
struct SawBlade {
    double radius;        ///< [m] from the axis of the swing to the tips
    double arc;           ///< [rad] of the swing, from one turning point to the other
    double pitch;         ///< [m] from tip to tip along the arc
    double tooth_count;   ///< [–] a whole number
    double thickness;     ///< [m] of the blade
    double set;           ///< [m] how far teeth stand out on either side, by turns
    double tooth_height;  ///< [m] from tip to root: as deep the front cuts

    [[nodiscard]] double kerf() const noexcept { return thickness + 2.0 * set; }  ///< [m]
    [[nodiscard]] double stroke() const noexcept { return radius * arc; }         ///< S [m] along the arc
    [[nodiscard]] std::size_t count() const noexcept { return static_cast<std::size_t>(tooth_count); }
    /// [rad] of the front at rest, and of all that it sweeps while it swings, from the middle to one end.
    [[nodiscard]] double half_front() const noexcept { return 0.5 * tooth_count * pitch / radius; }
    [[nodiscard]] double half_sweep() const noexcept { return half_front() + 0.5 * arc; }
    [[nodiscard]] double amplitude() const noexcept { return 0.5 * arc; }  ///< [rad] of the swing
    /// Where the front is at `angle` [rad] from the middle.
    [[nodiscard]] Vec3 on_front(SinCos angle) const noexcept {
        return {radius * angle.sin, 0.0, radius * (angle.cos - 1.0)};
    }
    /// The front at a fraction of itself, −1 … 1 from end to end.
    [[nodiscard]] FrontPoint front(double fraction) const noexcept {
        const SinCos angle = sin_cos_exact(fraction * half_front());
        return {on_front(angle), {angle.sin, 0.0, angle.cos}};
    }
    /// The end of what the front sweeps, on the +x side.
    [[nodiscard]] Vec3 end_of_sweep() const noexcept { return on_front(sin_cos_exact(half_sweep())); }
    /// The points on the front at `distance` [m] to either side of a tooth's tip.
    [[nodiscard]] std::array<Vec3, 2> beside(const Tooth& tooth, double distance) const noexcept {
        const SinCos angle = sin_cos_exact(distance / radius);
        const Vec3 middle = Vec3{0, 0, -radius} + (radius * angle.cos) * tooth.normal + Vec3{0, tooth.tip.y, 0},
                   aside = (radius * angle.sin) * tooth.along;
        return {middle - aside, middle + aside};
    }
};
/// All teeth, the blade swung by `swing` [rad].   [any] pure.
[[nodiscard]] Teeth teeth_of(const SawBlade& blade, double swing) noexcept;

}  // namespace kerf::sawing
