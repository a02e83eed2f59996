// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/field/cut/cut_field.h"

/// How flat and how true a cut was: its wall on the bone that stays, held against a plane.
namespace kerf {

/// Where the wall of a planned cut is looked for, body frame.
struct WallWindow {
    Vec3 entry{};             ///< [m] in the planned plane, where the cut's axis meets bone
    Vec3 along{};             ///< unit, the feed
    Vec3 normal{};            ///< unit, of the planned plane and across `along`: out of the bone that stays
    double half_width = 0.0;  ///< [m] to either side of the axis in the plane, and to either side of the plane
    double depth = 0.0;       ///< [m] along the axis
};

/// Appends the vertices of what is left of a body that lie on the cut, in the window, on a wall that looks along the
/// normal (within 45°). A vertex lies on the cut where bone was a voxel deep at least before: there only the cut can
/// end it.   [worker]
void add_wall_points(const Body& body, const CutField& cut, const WallWindow& window, std::vector<Vec3>& points);

/// A wall against its plan.
struct CutWall {
    double angle = 0.0;      ///< [rad] between the plane of least squares through the wall and the planned one
    double offset = 0.0;     ///< [m] along the normal, of the wall's middle from where the plan has it
    double flatness = 0.0;   ///< [m] between the two planes along that of least squares that hold the wall
    std::size_t points = 0;  ///< vertices it was fitted to
};

/// The plan has the wall half a kerf behind the plane, as the blade's middle runs in the plane.
/// Nothing where the points do not span a plane.   [any] pure.
[[nodiscard]] std::optional<CutWall> fit_wall(const std::vector<Vec3>& points, const WallWindow& window, double kerf);

}  // namespace kerf
