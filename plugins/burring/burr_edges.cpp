// SPDX-License-Identifier: Apache-2.0
#include "burr_edges.h"

#include <algorithm>

namespace kerf::burring {

namespace {

constexpr double end_normal = 0.8191520442889918;  // cos 35°: normals closer to the axis belong to the end
/// Shift of each column's points along the meridian, in twelfths of their spacing. Columns that mirror each other
/// differ by one twelfth.
constexpr std::array<double, column_count> staggered{0.5, 6.5, 2.5, 8.5, 4.5, 10.5, 11.5, 5.5, 9.5, 3.5, 7.5, 1.5};

}  // namespace

SinCos azimuth_of(std::size_t column) noexcept {
    return sin_cos_exact((static_cast<double>(column) + 0.5) * 2.0 * pi / static_cast<double>(column_count));
}

std::size_t EdgePoints::sector_of(const MeridianPoint& at, double along, double meridian, std::size_t column) noexcept {
    if (at.normal_z > end_normal) return 0;
    // Two columns form a sector. The columns on either side of x belong together.
    const std::size_t azimuth = (column + 1) / 2 % azimuth_count;
    return 1 + azimuth + (along > 0.5 * meridian ? azimuth_count : 0);
}

EdgePoints::EdgePoints(const BurrHead& head, const BurrParameters& law, const BoneQuery& bone) noexcept {
    const auto rings =
        static_cast<std::size_t>(std::min(law.edge_points, static_cast<double>(max_points))) / column_count;
    const double meridian = head.meridian(), ring = meridian / static_cast<double>(rings);
    const double deepest = 0.25 * head.widest_radius();
    for (std::size_t column = 0; column < column_count; ++column) {
        const SinCos around = azimuth_of(column);
        for (std::size_t n = 0; n < rings; ++n) {
            const double along = ring * (static_cast<double>(n) + staggered[column] / 12.0);
            const MeridianPoint p = head.at(along);
            EdgePoint& point = point_[count_];
            outwards_[count_] = {p.normal_r * around.cos, p.normal_r * around.sin, p.normal_z};
            point.at = {p.radius * around.cos, p.radius * around.sin, p.z};
            point.turning = {-around.sin, around.cos, 0.0};
            point.width = head.blades * ring / static_cast<double>(column_count);
            point.sector = sector_of(p, along, meridian, column);
            width_ += point.width;
            inside_[count_] = std::min(bone.wall_error() + p.sagitta(bone.voxel()), deepest);
            sample_point_[count_] = point.at - inside_[count_] * outwards_[count_];
            ++count_;
        }
    }
}

void EdgesInBone::sample(const EdgePoints& points, const BurrParameters& law, const BoneQuery& bone) noexcept {
    std::array<kerf_bone_sample, EdgePoints::max_points> found;
    const std::size_t count = points.count();
    points.sample(bone, {found.data(), count});
    for (std::size_t i = 0; i < count; ++i) {
        resisted[i] = resistance(found[i], bone.tissue_count(), law.reference_density);
        gap[i] = std::max(0.0, found[i].gap - points.inside(i));
        engaged += points[i].width * found[i].engagement;
    }
}

}  // namespace kerf::burring
