// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/field/grid/box.h"
#include "kerf/math.hpp"

/// Rays from outside that find the outer surface of a bone, without cavities and canals.
namespace kerf::bone {

/// The interface of a bone to fits.
struct BoneShape {
    std::function<double(Vec3)> distance;  ///< LPS [m] → [m], negative inside; a lower bound of the distance
    Box known{};                           ///< [m] data outside are not read
};

/// A point on the surface, or the reason why there is none.
struct RayHit {
    enum class Kind {
        surface,
        starts_in_bone,  ///< at `far`, or where the ray enters the known region
        none,
    };
    Kind kind = Kind::none;
    double radius = 0.0;  ///< [m] from the ray's centre
};

/// Returns the first bone on the ray from `centre + far · direction` to `centre`. `direction` is a unit vector.
/// Accurate to about 1 µm where the distance is exact.   [any] pure.
[[nodiscard]] RayHit surface_inwards(const BoneShape& bone, Vec3 centre, Vec3 direction, double far);

/// Returns `count` unit vectors spread evenly over all directions, on a spiral by the golden angle. The same bits on
/// every machine.
[[nodiscard]] std::vector<Vec3> even_directions(int count);

/// Returns 64 unit vectors perpendicular to `axis`, at equal angles. The same bits on every machine.
[[nodiscard]] std::vector<Vec3> directions_across(Vec3 axis);

}  // namespace kerf::bone
