// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "bone/radiograph/attenuation_image.h"

namespace kerf::test {

/// Returns what `bone_shadow` computes for one ray, by the slow and plain method: a trilinear sample of the image at
/// every tenth of a voxel. Voxels outside are water.
inline double marched(const bone::AttenuationImage& image, Vec3 source, Vec3 to) {
    const std::array<int, 3> n = image.voxels();
    const auto value = [&](int i, int j, int k) {
        const bool is_inside = i >= 0 && j >= 0 && k >= 0 && i < n[0] && j < n[1] && k < n[2];
        return is_inside ? image.value(i, j, k) - double{bone::AttenuationImage::water_value} : 0.0;
    };
    const double h = image.spacing(), step = 0.1 * h, reach = length(to - source);
    const Vec3 along = (1.0 / reach) * (to - source);
    const Vec3 middle = image.origin() + 0.5 * h * Vec3{n[0] - 1.0, n[1] - 1.0, n[2] - 1.0};
    const double nearest = dot(middle - source, along), half = 0.87 * h * std::max({n[0], n[1], n[2]});
    double sum = 0.0;
    for (double t = nearest - half; t < nearest + half; t += step) {
        const Vec3 v = (1.0 / h) * (source + t * along - image.origin());
        const int i = static_cast<int>(std::floor(v.x)), j = static_cast<int>(std::floor(v.y)),
                  k = static_cast<int>(std::floor(v.z));
        if (i < -1 || j < -1 || k < -1 || i >= n[0] || j >= n[1] || k >= n[2]) continue;
        for (int corner = 0; corner < 8; ++corner) {
            const int a = corner & 1, b = corner >> 1 & 1, c = corner >> 2;
            const double fx = a != 0 ? v.x - i : 1 - v.x + i, fy = b != 0 ? v.y - j : 1 - v.y + j,
                         fz = c != 0 ? v.z - k : 1 - v.z + k;
            sum += fx * fy * fz * value(i + a, j + b, k + c);
        }
    }
    return sum * step * bone::AttenuationImage::step;
}

}  // namespace kerf::test
