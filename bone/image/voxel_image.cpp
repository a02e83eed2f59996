// SPDX-License-Identifier: Apache-2.0
#include "bone/image/voxel_image.h"

#include <algorithm>

namespace kerf::bone {

double VoxelImage::sample_trilinear(Vec3 lps, double outside) const noexcept {
    // A point on the outermost voxel centre is inside, also after rounding.
    constexpr double rounding = 1e-6;  // [voxels]
    const Vec3 at_index = index(lps);
    const std::array<double, 3> where{at_index.x, at_index.y, at_index.z};
    std::array<int, 3> low{};
    std::array<double, 3> fraction{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double last = size[axis] - 1;
        // The negated condition puts NaN outside.
        if (!(where[axis] >= -rounding && where[axis] <= last + rounding)) return outside;
        const double inside = std::clamp(where[axis], 0.0, last);
        low[axis] = std::min(static_cast<int>(inside), std::max(0, size[axis] - 2));
        fraction[axis] = inside - low[axis];
    }
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        double weight = 1.0;
        std::array<int, 3> voxel = low;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const bool is_high = (corner >> axis & 1) != 0;
            weight *= is_high ? fraction[axis] : 1.0 - fraction[axis];
            voxel[axis] += is_high;
        }
        if (weight > 0.0) sum += weight * static_cast<double>(at(voxel[0], voxel[1], voxel[2]));
    }
    return sum;
}

VoxelImage VoxelImage::cropped(const VoxelRange& range) const {
    VoxelImage result;
    static_cast<VoxelGrid&>(result) = part(range);
    result.values.reserve(range.voxels());
    for (int k = 0; k < range.size[2]; ++k)
        for (int j = 0; j < range.size[1]; ++j) {
            const auto row = values.begin() + static_cast<std::ptrdiff_t>(
                                                  offset(range.first[0], range.first[1] + j, range.first[2] + k));
            result.values.insert(result.values.end(), row, row + range.size[0]);
        }
    return result;
}

Box VoxelGrid::box() const noexcept {
    Box all = empty_box;
    for (int corner = 0; corner < 8; ++corner) {
        const auto end = [&](std::size_t axis) {
            return corner >> axis & 1 ? static_cast<double>(size[axis] - 1) : 0.0;
        };
        const Vec3 p = lps({end(0), end(1), end(2)});
        all = joined(all, p);
    }
    return all;
}

VoxelRange VoxelGrid::range(const Box& box) const noexcept {
    std::array<double, 3> low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 at = index({corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                               corner & 4 ? box.high.z : box.low.z});
        const std::array<double, 3> where{at.x, at.y, at.z};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], where[axis]);
            high[axis] = std::max(high[axis], where[axis]);
        }
    }
    VoxelRange range;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double last = size[axis] - 1;
        if (!(high[axis] >= 0.0 && low[axis] <= last)) return {};
        range.first[axis] = static_cast<int>(std::floor(std::clamp(low[axis], 0.0, last)));
        range.size[axis] = static_cast<int>(std::ceil(std::clamp(high[axis], 0.0, last))) - range.first[axis] + 1;
        if (range.size[axis] < 2) return {};
    }
    return range;
}

VoxelGrid VoxelGrid::part(const VoxelRange& range) const noexcept {
    VoxelGrid grid;
    grid.size = range.size;
    grid.place(step(0), step(1), step(2),
               lps({static_cast<double>(range.first[0]), static_cast<double>(range.first[1]),
                    static_cast<double>(range.first[2])}));
    return grid;
}

bool VoxelGrid::is_sheared() const noexcept {
    constexpr double straight = 1e-3;  // [–] cosine
    const auto lean = [&](std::size_t a, std::size_t b) {
        return std::abs(dot(step(a), step(b))) / (spacing(a) * spacing(b));
    };
    return lean(0, 1) > straight || lean(1, 2) > straight || lean(2, 0) > straight;
}

bool on_one_grid(const VoxelGrid& a, const VoxelGrid& b) noexcept {
    if (a.size != b.size) return false;
    for (int corner = 0; corner < 8; ++corner) {
        const auto end = [&](std::size_t axis) {
            return corner >> axis & 1 ? static_cast<double>(a.size[axis] - 1) : 0.0;
        };
        const Vec3 index{end(0), end(1), end(2)};
        if (!(length(a.lps(index) - b.lps(index)) < 1e-5)) return false;
    }
    return true;
}

bool VoxelGrid::place(Vec3 i, Vec3 j, Vec3 k, Vec3 origin) noexcept {
    return place({i.x, j.x, k.x, origin.x, i.y, j.y, k.y, origin.y, i.z, j.z, k.z, origin.z});
}

bool VoxelGrid::place(const std::array<double, 12>& from_index) noexcept {
    const auto& m = from_index;
    const Vec3 a{m[0], m[4], m[8]}, b{m[1], m[5], m[9]}, c{m[2], m[6], m[10]}, origin{m[3], m[7], m[11]};
    const double determinant = dot(a, cross(b, c));
    const double volume = length(a) * length(b) * length(c);
    if (!(std::abs(determinant) > 1e-6 * volume) || !is_finite(origin) || !std::isfinite(determinant)) return false;

    const std::array<Vec3, 3> rows{cross(b, c) / determinant, cross(c, a) / determinant, cross(a, b) / determinant};
    lps_from_index = from_index;
    for (std::size_t r = 0; r < 3; ++r) {
        index_from_lps[4 * r] = rows[r].x;
        index_from_lps[4 * r + 1] = rows[r].y;
        index_from_lps[4 * r + 2] = rows[r].z;
        index_from_lps[4 * r + 3] = -dot(rows[r], origin);
    }
    return true;
}

}  // namespace kerf::bone
