// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/field/cut/cut_field.h"

/// Flatness and accuracy of a cut: its wall on the remaining bone, compared with the planned plane.
namespace kerf::bone {

/// The region around a planned cut that is searched for its wall, body frame.
struct WallWindow {
    Vec3 entry{};             ///< [m] in the planned plane, where the cut's axis meets bone
    Vec3 along{};             ///< unit, direction of feed
    Vec3 normal{};            ///< unit, normal of the planned plane, at right angles to `along`, out of the remaining
                              ///< bone
    double half_width = 0.0;  ///< [m] to both sides of the axis in the plane, and to both sides of the plane
    double depth = 0.0;       ///< [m] along the axis
};

/// Appends the vertices of the remaining body that lie on the cut, in the window, on a wall whose normal is within 45°
/// of the window's. A vertex lies on the cut if bone was at least a voxel deep there before: only the cut can end it
/// there.   [worker]
void add_wall_points(const Body& body, const CutField& cut, const WallWindow& window, std::vector<Vec3>& points);

/// A wall compared with its plan.
struct CutWall {
    double angle = 0.0;      ///< [rad] between the least-squares plane of the wall and the planned plane
    double offset = 0.0;     ///< [m] along the normal, from the planned position to the middle of the wall
    double flatness = 0.0;   ///< [m] distance of the two planes parallel to the least-squares plane that enclose the
                             ///< wall
    std::size_t points = 0;  ///< fitted vertices
};

/// Returns the wall's fit. The planned wall lies half a kerf behind the plane, because the blade's middle runs in the
/// plane. Nothing if the points do not span a plane.   [any] pure.
[[nodiscard]] std::optional<CutWall> fit_wall(const std::vector<Vec3>& points, const WallWindow& window, double kerf);

}  // namespace kerf::bone
