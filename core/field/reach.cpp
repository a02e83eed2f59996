// SPDX-License-Identifier: Apache-2.0
#include "core/field/reach.h"

#include <algorithm>
#include <cmath>

namespace kerf {

bool is_in_reach_of_bone(const Body& body, const RevolutionSolid& solid, const Pose& body_from_tool,
                         double margin) noexcept {
    const Grid& g = body.grid();
    const Vec3 tip = body_from_tool * Vec3{0, 0, solid.tip_z()};
    const Vec3 end = body_from_tool * Vec3{0, 0, solid.end_z()};
    const double around = solid.largest_radius() + margin;
    const double edge = brick_edge * g.spacing;
    const auto first = [&](double a, double b, double o) {
        return std::max(0, static_cast<int>(std::floor((std::min(a, b) - around - o) / edge)));
    };
    const auto last = [&](double a, double b, double o, int n) {
        return std::min(n - 1, static_cast<int>(std::floor((std::max(a, b) + around - o) / edge)));
    };
    for (int k = first(tip.z, end.z, g.origin.z); k <= last(tip.z, end.z, g.origin.z, g.bricks[2]); ++k)
        for (int j = first(tip.y, end.y, g.origin.y); j <= last(tip.y, end.y, g.origin.y, g.bricks[1]); ++j)
            for (int i = first(tip.x, end.x, g.origin.x); i <= last(tip.x, end.x, g.origin.x, g.bricks[0]); ++i)
                if (!body.surface.is_all_air(g.brick_index(i, j, k))) return true;
    return false;
}

}  // namespace kerf
