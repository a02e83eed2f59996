// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <vector>

#include "core/field/grid/box.h"
#include "documents/outline.h"
#include "kerf/math.hpp"

namespace kerf::documents {

/// A curve across a path: a superellipse |2x/width|^e + |2y/height|^e = 1, or an outline.
struct LoftSection {
    Vec3 at{};                         ///< [m] its middle
    double width = 0.0, height = 0.0;  ///< [m] full axes; `height` in the direction `up`
    double exponent = 2.0;             ///< [–] 2: an ellipse; larger: squarer
    double taper = 0.0;                ///< [–] `width` is smaller by this part on top, and larger below
    double turn = 0.0;                 ///< [rad] of the section about the path, from `up`
    Outline outline{};                 ///< points from its middle, x across `up`; empty: a superellipse
};

/// The loft at a point of its path.
struct LoftFrame {
    Vec3 at{}, along{}, side{}, up{};            ///< [m]; unit
    double half_width = 0.0, half_height = 0.0;  ///< [m]
    double exponent = 2.0, taper = 0.0;          ///< [–]
    double widening = 0.0, heightening = 0.0;    ///< [–] slopes of both along the path
    double from_start = 0.0;                     ///< [m] of the path
};

/// A solid through sections along a smooth path, cut flat at both ends. Middles follow a cubic through the sections
/// (slopes by finite differences), sizes a monotone cubic [fritsch-carlson-1980].
struct LoftSolid {
    std::vector<LoftSection> sections{};
    Vec3 up{0, 0, 1};
    double rim = 0.0;                 ///< [m] radius by which both ends are rounded
    std::vector<LoftFrame> path{};    ///< of `lay_path`: close together, from the first section to the last
    Box bounds{};                     ///< [m] of `lay_path`
    std::vector<Outline> outlines{};  ///< of `lay_path`: for each point of the path, smoothed; empty: superellipses
    double sharpest = HUGE_VAL;       ///< [m] of `lay_path`: radius of the sharpest corner of both end outlines
};

/// Computes `path` and `bounds`.   [main]
/// Pre: two sections or more, not at the same position; `up` is nowhere along the path. All sections have an outline
/// with as many points, or none has one.
void lay_path(LoftSolid& loft);

/// Returns the largest half width or half height in radii of the path's curvature [–]. From 1 on, sections cross.
/// [any] pure
[[nodiscard]] double crossing(const LoftSolid& loft) noexcept;

/// Returns whether an outline crosses itself between the sections.   [any] pure
[[nodiscard]] bool has_crossed_outline(const LoftSolid& loft) noexcept;

/// Returns the signed distance to a loft [m], negative inside. For ellipses whose axes are up to 1 : 3, and sizes that
/// change by up to 0.5 along the path, its error is at most 3 % plus 0.02 mm inside and up to 3 mm outside. Farther
/// outside it may be smaller, but not than the distance to the bounds. A distance of more than `limit` [m] may be
/// smaller, but not than `limit`.   [any] pure
[[nodiscard]] double distance_to(const LoftSolid& loft, Vec3 point, double limit = HUGE_VAL) noexcept;

}  // namespace kerf::documents
