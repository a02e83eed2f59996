// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "core/import/image/read_image.h"

namespace kerf {

double VoxelImage::sample_trilinear(Vec3 lps, double outside) const noexcept {
    // A point on the outermost voxel centre is inside, also after rounding.
    constexpr double rounding = 1e-6;  // [voxels]
    const Vec3 at_index = index(lps);
    const std::array<double, 3> where{at_index.x, at_index.y, at_index.z};
    std::array<int, 3> low{};
    std::array<double, 3> share{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double last = size[axis] - 1;
        // Written so that NaN is outside.
        if (!(where[axis] >= -rounding && where[axis] <= last + rounding)) return outside;
        const double inside = std::clamp(where[axis], 0.0, last);
        low[axis] = std::min(static_cast<int>(inside), std::max(0, size[axis] - 2));
        share[axis] = inside - low[axis];
    }
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        double weight = 1.0;
        std::array<int, 3> voxel = low;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const bool is_high = (corner >> axis & 1) != 0;
            weight *= is_high ? share[axis] : 1.0 - share[axis];
            voxel[axis] += is_high;
        }
        if (weight > 0.0) sum += weight * static_cast<double>(at(voxel[0], voxel[1], voxel[2]));
    }
    return sum;
}

bool VoxelImage::place(const std::array<double, 12>& from_index) noexcept {
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

}  // namespace kerf
