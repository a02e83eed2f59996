// SPDX-License-Identifier: Apache-2.0
#include "bone/measure/cut_wall.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>

#include "core/field/surface/brick_mesher.h"

namespace kerf::bone {

namespace {

struct InWindow {
    double deep, aside, off;  ///< [m] along the axis, across it in the plane, along the normal
};
InWindow in_window(const WallWindow& window, Vec3 p) noexcept {
    const Vec3 from_entry = p - window.entry;
    return {dot(from_entry, window.along), dot(from_entry, cross(window.normal, window.along)),
            dot(from_entry, window.normal)};
}
bool is_in(const WallWindow& window, Vec3 p, double margin) noexcept {
    const auto [deep, aside, off] = in_window(window, p);
    return deep >= -margin && deep <= window.depth + margin && std::abs(aside) <= window.half_width + margin &&
           std::abs(off) <= window.half_width + margin;
}

}  // namespace

void add_wall_points(const Body& body, const CutField& cut, const WallWindow& window, std::vector<Vec3>& points) {
    const Grid& grid = body.grid();
    const double half_brick = 0.5 * brick_edge * grid.spacing, brick_reach = half_brick * std::sqrt(3.0);
    const double min_cosine = std::sqrt(0.5);
    const auto mesher = std::make_unique<BrickMesher>(body);
    for (std::size_t brick = 0; brick < grid.brick_count(); ++brick) {
        const auto [i, j, k] = grid.brick_coordinates(brick);
        const Vec3 middle = grid.sample_position(i * brick_edge, j * brick_edge, k * brick_edge) +
                            Vec3{half_brick, half_brick, half_brick};
        if (!is_in(window, middle, brick_reach + grid.spacing) || !mesher->may_cross(cut, brick)) continue;
        const PatchView patch = mesher->mesh(cut, brick);
        for (const SurfaceVertex& vertex : patch.vertices) {
            const auto& [position, normal] = vertex;
            const Vec3 p{double{position[0]}, double{position[1]}, double{position[2]}};
            const Vec3 outwards{double{normal[0]}, double{normal[1]}, double{normal[2]}};
            if (dot(outwards, window.normal) < min_cosine || !is_in(window, p, 0.0)) continue;
            if (uncut_distance(body, locate(body, p)) < -grid.spacing) points.push_back(p);
        }
    }
}

std::optional<CutWall> fit_wall(const std::vector<Vec3>& points, const WallWindow& window, double kerf) {
    if (points.size() < 3) return {};
    // off = mean + a (deep − mean deep) + b (aside − mean aside), by least squares
    const double count = static_cast<double>(points.size());
    InWindow mean{};
    for (const Vec3 p : points) {
        const InWindow at = in_window(window, p);
        mean = {mean.deep + at.deep / count, mean.aside + at.aside / count, mean.off + at.off / count};
    }
    double dd = 0.0, da = 0.0, aa = 0.0, od = 0.0, oa = 0.0;
    for (const Vec3 p : points) {
        const InWindow at = in_window(window, p);
        const double d = at.deep - mean.deep, a = at.aside - mean.aside, o = at.off - mean.off;
        dd += d * d;
        da += d * a;
        aa += a * a;
        od += o * d;
        oa += o * a;
    }
    const double determinant = dd * aa - da * da;
    if (!(determinant > 1e-6 * dd * aa)) return {};  // nearly collinear points
    const double slope_deep = (od * aa - oa * da) / determinant, slope_aside = (oa * dd - od * da) / determinant;
    const double slope = std::sqrt(slope_deep * slope_deep + slope_aside * slope_aside);

    double smallest = HUGE_VAL, largest = -HUGE_VAL;
    for (const Vec3 p : points) {
        const InWindow at = in_window(window, p);
        const double left =
            at.off - mean.off - slope_deep * (at.deep - mean.deep) - slope_aside * (at.aside - mean.aside);
        smallest = std::min(smallest, left);
        largest = std::max(largest, left);
    }
    return CutWall{std::atan(slope), std::abs(mean.off + 0.5 * kerf),
                   (largest - smallest) / std::sqrt(1.0 + slope * slope), points.size()};
}

}  // namespace kerf::bone
