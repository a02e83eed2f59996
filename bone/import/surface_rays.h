// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/field/grid/box.h"
#include "kerf/math.hpp"

/// Points on the outside of a bone, found by rays that come from outside: cavities and canals do not count.
namespace kerf {

/// A bone as fits see it.
struct BoneShape {
    std::function<double(Vec3)> distance;  ///< LPS [m] → [m], negative inside; never more than the distance itself
    Box known{};                           ///< [m] what lies outside was not read
};

/// A point on the surface, or why there is none.
struct RayHit {
    enum class Kind {
        surface,
        starts_in_bone,  ///< at `far`, or where the ray leaves what is known
        none,
    };
    Kind kind = Kind::none;
    double radius = 0.0;  ///< [m] from the ray's centre
};

/// Finds where bone begins on the way from `centre + far · direction` to `centre`. `direction` is a unit vector.
/// Accurate to about 1 µm where the distance is exact.   [any] pure.
[[nodiscard]] RayHit surface_inwards(const BoneShape& bone, Vec3 centre, Vec3 direction, double far);

/// `count` unit vectors that are spread evenly over all directions: a spiral by the golden angle. The same bits on
/// every machine.
[[nodiscard]] std::vector<Vec3> even_directions(int count);

/// 64 unit vectors across `axis`, at equal angles. The same bits on every machine.
[[nodiscard]] std::vector<Vec3> directions_across(Vec3 axis);

}  // namespace kerf
