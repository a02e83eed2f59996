// SPDX-License-Identifier: Apache-2.0
#include "core/import/voxel_distance.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace kerf {
namespace {

/// Distance to a plane that crosses the axes at `ways` [m]; HUGE_VAL: it does not cross that one.
double distance_to_plane(const std::array<double, 3>& ways) {
    double sum = 0.0;
    for (const double way : ways) sum += 1.0 / (std::max(way, 1e-9) * std::max(way, 1e-9));
    return sum > 0.0 ? 1.0 / std::sqrt(sum) : HUGE_VAL;
}

/// The distance at a voxel whose face_neighbours along the axes lie `near` [m] from the border: |∇d| = 1, upwind.
double solved(std::array<double, 3> near, std::array<double, 3> spacing) {
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

/// Where the border crosses the line through four voxels between the second and the third, as a share of the way; `inner` and
/// `outer` are the next ones. Either way round.
double crossing(double inner, double here, double there, double outer, double threshold) {
    constexpr double blurred = 0.2;  // of all there is between bone and air: a border that takes so much in two voxels is not sharp
    const double share = (here - threshold) / (here - there);
    const bool falls = here > there;
    const double full = falls ? std::max(inner, here) : std::min(inner, here), empty = falls ? std::min(outer, there) : std::max(outer, there);
    const double whole = full - empty;
    const double sharpness = 1.0 - std::min((full - here) / whole, (there - empty) / whole) / blurred;
    if (sharpness <= 0.0) return share;
    return sharpness * std::clamp((here + there - empty - threshold) / whole, 0.0, 1.0) + (1.0 - sharpness) * share;
}

}  // namespace

VoxelDistance distance_in_voxels(const BoneMask& mask, double threshold, double farthest) {
    std::size_t faces = 0, crossings = 0;
    const VoxelImage& image = mask.image;
    VoxelImage result = image;
    std::vector<double> distance(image.values.size(), HUGE_VAL);
    std::vector<std::uint8_t> is_fixed(image.values.size(), 0);
    const std::array<double, 3> spacing{image.spacing(0), image.spacing(1), image.spacing(2)};

    // Voxels beside the border: from where it crosses the lines to their face_neighbours.
    for_each_voxel(image, [&](int i, int j, int k, std::size_t at) {
        std::array<double, 3> ways{HUGE_VAL, HUGE_VAL, HUGE_VAL};
        const bool is_bone = mask.is_bone[at] != 0;
        for (std::size_t n = 0; n < face_neighbours.size(); ++n) {
            const auto& [x, y, z] = face_neighbours[n];
            if (!image.has(i + x, j + y, k + z) || mask.at(i + x, j + y, k + z) == is_bone) continue;
            const auto here = static_cast<double>(image.values[at]);
            const auto there = static_cast<double>(image.at(i + x, j + y, k + z));
            const bool crosses =
                is_bone ? here >= threshold && there < threshold : here < threshold && there >= threshold;
            ++faces;
            crossings += crosses;
            const auto value = [&](int steps, double otherwise) {
                const int a = i + steps * x, b = j + steps * y, c = k + steps * z;
                return image.has(a, b, c) ? static_cast<double>(image.at(a, b, c)) : otherwise;
            };
            const double share = crosses ? crossing(value(-1, here), here, there, value(2, there), threshold) : 0.5;
            ways[n / 2] = std::min(ways[n / 2], share * spacing[n / 2]);
        }
        const double near = distance_to_plane(ways);
        if (near == HUGE_VAL) return;
        distance[at] = near;
        is_fixed[at] = 1;
    });

    // All others, in the eight directions in which the nearest border can lie; again, for winding bone, until nothing
    // comes nearer.
    const std::array<std::ptrdiff_t, 3> stride{1, image.size[0],
                                               static_cast<std::ptrdiff_t>(image.size[0]) * image.size[1]};
    for (int round = 0; round < 2; ++round) {
        bool has_changed = false;
        for (int sweep = 0; sweep < 8; ++sweep) {
            const auto along = [&](std::size_t axis, int n) { return sweep >> axis & 1 ? image.size[axis] - 1 - n : n; };
            for (int c = 0; c < image.size[2]; ++c)
                for (int b = 0; b < image.size[1]; ++b)
                    for (int a = 0; a < image.size[0]; ++a) {
                        const std::array<int, 3> v{along(0, a), along(1, b), along(2, c)};
                        const std::size_t at = image.offset(v[0], v[1], v[2]);
                        if (is_fixed[at] != 0) continue;
                        std::array<double, 3> near;
                        for (std::size_t axis = 0; axis < 3; ++axis) {
                            const double* here = distance.data() + at;
                            const double before = v[axis] > 0 ? here[-stride[axis]] : HUGE_VAL;
                            const double behind = v[axis] + 1 < image.size[axis] ? here[stride[axis]] : HUGE_VAL;
                            near[axis] = std::min(before, behind);
                        }
                        if (std::min({near[0], near[1], near[2]}) >= std::min(distance[at], farthest)) continue;
                        const double found = solved(near, spacing);
                        if (found >= distance[at]) continue;
                        distance[at] = found;
                        has_changed = true;
                    }
        }
        if (!has_changed) break;
    }
    for (std::size_t at = 0; at < distance.size(); ++at) {
        const double capped = std::min(distance[at], farthest);
        result.values[at] = static_cast<float>(mask.is_bone[at] != 0 ? -capped : capped);
    }
    return {std::move(result), faces > 0 ? static_cast<double>(crossings) / static_cast<double>(faces) : 0.0};
}

}  // namespace kerf
