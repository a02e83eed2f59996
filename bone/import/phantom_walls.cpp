// SPDX-License-Identifier: Apache-2.0
#include "bone/import/phantom_walls.h"

#include <algorithm>
#include <cmath>

namespace kerf::bone {

namespace {
constexpr double facing = -0.8;  // [–] cosine between the outward normals on both sides of a wall
}  // namespace

std::vector<WallSample> phantom_walls(const LevelSet& field, DistanceSource& source, double limit) {
    const Grid& grid = field.grid();
    const double h = grid.spacing, finest = 0.02 * h;
    const auto distance = [&](Vec3 p, double reach) { return source.at(p, {-reach, reach}); };
    const auto outward_normal = [&](Vec3 p) {
        const double d = 0.05 * h;
        const auto slope = [&](Vec3 to) { return distance(p + to, h) - distance(p - to, h); };
        return normalized(Vec3{slope({d, 0, 0}), slope({0, d, 0}), slope({0, 0, d})});
    };
    const auto in_field = [&](Vec3 p) { return field.at(locate(grid, p)); };
    // A distance is 1-Lipschitz. So bone that is this deep at each voxel of a line is bone between them.
    const auto is_thick = [&](Vec3 p) {
        const Vec3 out = normalized(Vec3{in_field(p + Vec3{h, 0, 0}) - in_field(p - Vec3{h, 0, 0}),
                                         in_field(p + Vec3{0, h, 0}) - in_field(p - Vec3{0, h, 0}),
                                         in_field(p + Vec3{0, 0, h}) - in_field(p - Vec3{0, 0, h})});
        const Vec3 at = p - in_field(p) * out;
        constexpr double deep = 0.6;  // [–] depth over the travel inwards
        for (double travel = h; travel < limit + 0.5 * h; travel += h)
            if (-in_field(at - travel * out) < deep * travel) return false;
        return true;
    };
    std::vector<WallSample> walls;
    const auto measure_at = [&](Vec3 p) {
        if (is_thick(p)) return walls.push_back({HUGE_VAL, h * h, p});
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
    const auto is_at_surface = [&](std::int16_t sample) {
        return std::abs(sample * grid.quantum()) <= 0.5 * h + grid.quantum();
    };
    for (int k = 0; k < grid.bricks[2]; ++k)
        for (int j = 0; j < grid.bricks[1]; ++j)
            for (int i = 0; i < grid.bricks[0]; ++i) {
                if (!field.has_border(grid.brick_index(i, j, k))) continue;
                for (int n = 0; n < brick_edge * brick_edge * brick_edge; ++n) {
                    const int x = i * brick_edge + n % brick_edge, y = j * brick_edge + n / brick_edge % brick_edge,
                              z = k * brick_edge + n / (brick_edge * brick_edge);
                    if (is_at_surface(field.sample(x, y, z))) measure_at(grid.sample_position(x, y, z));
                }
            }
    return walls;
}

}  // namespace kerf::bone
