// SPDX-License-Identifier: Apache-2.0
#include "core/field/cut/reach.h"

#include <algorithm>
#include <cmath>

namespace kerf {

bool is_in_reach_of_bone(const Body& body, const ToolSolid& solid, const Pose& body_from_tool, double margin,
                         CutOnly cut_only) noexcept {
    const Grid& g = body.grid();
    const Vec3 around{margin, margin, margin};
    const auto [lowest, highest] = solid.box(body_from_tool);
    Vec3 low = lowest - around, high = highest + around;
    if (cut_only == CutOnly::yes && !body.region.meets(low, high)) return false;
    low = body.region.nearest(low);  // outside the region, bone continues as on its nearest face
    high = body.region.nearest(high);

    const double edge = brick_edge * g.spacing;
    const auto first = [&](double from, double origin) {
        return std::max(0, static_cast<int>(std::floor((from - origin) / edge)));
    };
    const auto last = [&](double to, double origin, int n) {
        return std::min(n - 1, static_cast<int>(std::floor((to - origin) / edge)));
    };
    for (int k = first(low.z, g.origin.z); k <= last(high.z, g.origin.z, g.bricks[2]); ++k)
        for (int j = first(low.y, g.origin.y); j <= last(high.y, g.origin.y, g.bricks[1]); ++j)
            for (int i = first(low.x, g.origin.x); i <= last(high.x, g.origin.x, g.bricks[0]); ++i)
                if (!body.surface.is_all_air(g.brick_index(i, j, k))) return true;
    return false;
}

}  // namespace kerf
