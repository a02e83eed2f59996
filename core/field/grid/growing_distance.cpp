// SPDX-License-Identifier: Apache-2.0
#include "core/field/grid/growing_distance.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace kerf {

namespace {

/// Returns the distance [m] at a point by |∇d| = 1, upwind. `near` [m]: the smaller distance of its two neighbours
/// along each axis.
double solve_eikonal(std::array<double, 3> near, std::array<double, 3> spacing) {
    for (std::size_t a = 0; a < 2; ++a)  // nearest first
        for (std::size_t b = 0; b < 2 - a; ++b)
            if (near[b] > near[b + 1]) {
                std::swap(near[b], near[b + 1]);
                std::swap(spacing[b], spacing[b + 1]);
            }
    double distance = HUGE_VAL;
    double s0 = 0.0, s1 = 0.0, s2 = 0.0;  // Σ 1/h², Σ n/h², Σ n²/h²
    for (std::size_t axis = 0; axis < 3 && near[axis] < distance; ++axis) {
        const double w = 1.0 / (spacing[axis] * spacing[axis]);
        s0 += w;
        s1 += w * near[axis];
        s2 += w * near[axis] * near[axis];
        const double root = s1 * s1 - s0 * (s2 - 1.0);
        if (root < 0.0) break;
        distance = (s1 + std::sqrt(root)) / s0;
    }
    return distance;
}

}  // namespace

void grow_distances(const std::array<int, 3>& size, const std::array<double, 3>& spacing,
                    const std::vector<std::uint8_t>& is_fixed, double farthest, std::vector<double>& distance) {
    const std::array<std::ptrdiff_t, 3> stride{1, size[0], static_cast<std::ptrdiff_t>(size[0]) * size[1]};
    // Eight sweeps, one per octant in which the nearest fixed point can lie. The second round is for winding bone.
    for (int round = 0; round < 2; ++round) {
        bool has_changed = false;
        for (int sweep = 0; sweep < 8; ++sweep) {
            const auto along = [&](std::size_t axis, int n) { return sweep >> axis & 1 ? size[axis] - 1 - n : n; };
            for (int c = 0; c < size[2]; ++c)
                for (int b = 0; b < size[1]; ++b)
                    for (int a = 0; a < size[0]; ++a) {
                        const std::array<int, 3> v{along(0, a), along(1, b), along(2, c)};
                        const auto at = static_cast<std::size_t>(v[0] + v[1] * stride[1] + v[2] * stride[2]);
                        if (is_fixed[at] != 0) continue;
                        std::array<double, 3> near;
                        for (std::size_t axis = 0; axis < 3; ++axis) {
                            const double* here = distance.data() + at;
                            const double before = v[axis] > 0 ? here[-stride[axis]] : HUGE_VAL;
                            const double behind = v[axis] + 1 < size[axis] ? here[stride[axis]] : HUGE_VAL;
                            near[axis] = std::min(before, behind);
                        }
                        if (std::min({near[0], near[1], near[2]}) >= std::min(distance[at], farthest)) continue;
                        const double found = solve_eikonal(near, spacing);
                        if (found >= distance[at]) continue;
                        distance[at] = found;
                        has_changed = true;
                    }
        }
        if (!has_changed) break;
    }
}

}  // namespace kerf
