// SPDX-License-Identifier: Apache-2.0
#include "bone/import/phantom_walls.h"

#include <algorithm>
#include <cmath>

namespace kerf::bone {

namespace {
constexpr double facing = -0.8;  // [–] cosine between the outward normals on both sides of a wall
}  // namespace

std::vector<WallSample> phantom_walls(const Grid& grid, DistanceSource& source, double limit) {
    const double h = grid.spacing, finest = 0.02 * h;
    const auto distance = [&](Vec3 p, double reach) { return source.at(p, {-reach, reach}); };
    const auto outward_normal = [&](Vec3 p) {
        const double d = 0.05 * h;
        const auto slope = [&](Vec3 to) { return distance(p + to, h) - distance(p - to, h); };
        return normalized(Vec3{slope({d, 0, 0}), slope({0, d, 0}), slope({0, 0, d})});
    };
    std::vector<WallSample> walls;
    const auto measure_at = [&](Vec3 p) {
        const double d = distance(p, 0.5 * h);
        if (std::abs(d) > 0.5 * h) return;
        const Vec3 out = outward_normal(p), at = p - d * out;
        // Inside, the distance is a lower bound for the step to the other side.
        double thickness = finest, depth = -distance(at - thickness * out, limit);
        for (; thickness < limit && depth > 0.0; depth = -distance(at - thickness * out, limit))
            thickness += std::max(depth, finest);
        thickness += std::min(depth, 0.0);  // the last step overshot by this distance
        if (thickness >= limit) return walls.push_back({HUGE_VAL, h * h, at});
        if (dot(out, outward_normal(at - thickness * out)) < facing) walls.push_back({thickness, h * h, at});
    };
    const double half = 0.5 * brick_edge * h, in_brick = std::sqrt(3.0) * half;
    for (int k = 0; k < grid.bricks[2]; ++k)
        for (int j = 0; j < grid.bricks[1]; ++j)
            for (int i = 0; i < grid.bricks[0]; ++i) {
                const int x = i * brick_edge, y = j * brick_edge, z = k * brick_edge;
                if (std::abs(distance(grid.sample_position(x, y, z) + Vec3{half, half, half}, in_brick + h)) >
                    in_brick + h)
                    continue;
                for (int n = 0; n < brick_edge * brick_edge * brick_edge; ++n)
                    measure_at(grid.sample_position(x + n % brick_edge, y + n / brick_edge % brick_edge,
                                                    z + n / (brick_edge * brick_edge)));
            }
    return walls;
}

}  // namespace kerf::bone
