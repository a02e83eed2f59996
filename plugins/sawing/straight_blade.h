// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "kerf/math.hpp"
#include "saw_blade.h"

/// Geometry of a reciprocating saw's blade: a row of teeth along one long edge.
namespace kerf::sawing {

/// Tool frame: origin at the tip, in the middle of the toothed edge; +z out of that edge, x along the blade, which is
/// the direction of the teeth's motion, y across the blade. The handpiece clamps the blade at its −x end.
struct StraightBlade {
    double length;        ///< [m] along x
    double height;        ///< [m] from the back edge to the tips of the teeth
    double travel;        ///< [m] of a stroke, from one turning point to the other
    double pitch;         ///< [m] from tip to tip
    double tooth_count;   ///< [–] a whole number: the teeth that fit on the length
    double thickness;     ///< [m] of the blade
    double set;           ///< [m] protrusion of the teeth on alternate sides
    double tooth_height;  ///< [m] from tip to root, the cutting depth of the front

    [[nodiscard]] double kerf() const noexcept { return thickness + 2.0 * set; }  ///< [m]
    [[nodiscard]] double stroke() const noexcept { return travel; }               ///< S [m]
    [[nodiscard]] std::size_t count() const noexcept { return static_cast<std::size_t>(tooth_count); }
    /// [m] half length of the toothed edge at rest, and of its sweep in a stroke.
    [[nodiscard]] double half_front() const noexcept { return 0.5 * tooth_count * pitch; }
    [[nodiscard]] double half_sweep() const noexcept { return half_front() + 0.5 * travel; }
    [[nodiscard]] double amplitude() const noexcept { return 0.5 * travel; }  ///< [m] of the swing
    /// Returns the point of the front at a fraction of its length, −1 … 1 from end to end.
    [[nodiscard]] FrontPoint front(double fraction) const noexcept {
        return {{fraction * half_front(), 0.0, 0.0}, {0.0, 0.0, 1.0}};
    }
    /// Returns the end of the front's sweep on the +x side.
    [[nodiscard]] Vec3 end_of_sweep() const noexcept { return {half_sweep(), 0.0, 0.0}; }
    /// Returns the points on the front at `distance` [m] to either side of a tooth's tip.
    [[nodiscard]] std::array<Vec3, 2> points_around(const Tooth& tooth, double distance) const noexcept {
        return {tooth.tip - Vec3{distance, 0.0, 0.0}, tooth.tip + Vec3{distance, 0.0, 0.0}};
    }
    /// Returns z of the blade's long axis, midway between its edges [m].
    [[nodiscard]] double middle_z() const noexcept { return -0.5 * height; }
};

/// Returns all teeth of a blade displaced along x by `swing` [m].   [any] pure.
[[nodiscard]] inline Teeth teeth_of(const StraightBlade& blade, double swing) noexcept {
    Teeth teeth;
    teeth.count = std::min(blade.count(), max_teeth);
    for (std::size_t i = 0; i < teeth.count; ++i) {
        Tooth& t = teeth.tooth[i];
        t.side = i % 2 == 0 ? 1.0 : -1.0;
        const double from_middle = static_cast<double>(i) - 0.5 * static_cast<double>(teeth.count - 1);
        t.tip = {from_middle * blade.pitch + swing, 0.25 * t.side * blade.kerf(), 0.0};
        t.normal = {0.0, 0.0, 1.0};
        t.along = {1.0, 0.0, 0.0};
    }
    return teeth;
}

}  // namespace kerf::sawing
