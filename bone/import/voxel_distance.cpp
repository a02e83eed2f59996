// SPDX-License-Identifier: Apache-2.0
#include "bone/import/voxel_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/field/grid/growing_distance.h"

namespace kerf::bone {
namespace {

/// Returns the distance to a plane from its crossings of the axes [m]; HUGE_VAL: it does not cross that axis.
double distance_to_plane(const std::array<double, 3>& axis_distances) {
    double sum = 0.0;
    for (const double sign : axis_distances) sum += 1.0 / (std::max(sign, 1e-9) * std::max(sign, 1e-9));
    return sum > 0.0 ? 1.0 / std::sqrt(sum) : HUGE_VAL;
}

/// Voxels on one side of a border, beginning next to it.
using Side = std::array<double, 5>;

/// Returns the value of pure bone or air on one side: the mean of the next three voxels, up to another border. It is
/// not the larger of this mean and the first voxel: noise makes that too large and would move the border towards the
/// middle between two voxels. The last argument is 1 for bone, −1 for air.
double whole_of(const Side& side, double threshold, double sign) {
    const auto is_beyond = [&](double value) { return sign * (value - threshold) < 0.0; };
    if (is_beyond(side[2])) return sign * (side[0] - side[1]) > 0.0 ? side[0] : side[1];
    double sum = side[1];
    std::size_t count = 1;
    while (count < 3 && !is_beyond(side[count + 2])) sum += side[++count];
    return sum / static_cast<double>(count);
}

/// Returns the border between the first voxels on both sides, as a fraction of their distance.
double crossing(const Side& inner, const Side& outer, double threshold) {
    constexpr double blurred =
        0.2;  // [–] of the step from bone to air: a border with this much in the next voxels is not sharp
    const double here = inner[0], there = outer[0];
    const double share = (here - threshold) / (here - there);
    const double sign = here > there ? 1.0 : -1.0;
    const double full = whole_of(inner, threshold, sign), empty = whole_of(outer, threshold, -sign);
    const double whole = full - empty;
    if (sign * whole <= std::abs(here - there)) return share;  // a smaller step is noise: both are pure
    const double sharpness = std::min(1.0, 1.0 - std::min((full - here) / whole, (there - empty) / whole) / blurred);
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

    // Voxels next to the border: by the crossings on the lines to their neighbours.
    for_each_voxel(image, [&](int i, int j, int k, std::size_t at) {
        std::array<double, 3> axis_distances{HUGE_VAL, HUGE_VAL, HUGE_VAL};
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
            const auto value = [&, x = x, y = y, z = z](int steps, double otherwise) {
                const int a = i + steps * x, b = j + steps * y, c = k + steps * z;
                return image.has(a, b, c) ? static_cast<double>(image.at(a, b, c)) : otherwise;
            };
            const auto fraction_of_distance = [&] {
                Side inner{here}, outer{there};
                for (std::size_t step = 1; step < inner.size(); ++step) {  // beyond the image as at its end
                    inner[step] = value(-static_cast<int>(step), inner[step - 1]);
                    outer[step] = value(1 + static_cast<int>(step), outer[step - 1]);
                }
                return crossing(inner, outer, threshold);
            };
            axis_distances[n / 2] =
                std::min(axis_distances[n / 2], (crosses ? fraction_of_distance() : 0.5) * spacing[n / 2]);
        }
        const double near = distance_to_plane(axis_distances);
        if (near == HUGE_VAL) return;
        distance[at] = near;
        is_fixed[at] = 1;
    });

    grow_distances(image.size, spacing, is_fixed, farthest, distance);
    for (std::size_t at = 0; at < distance.size(); ++at) {
        const double capped = std::min(distance[at], farthest);
        result.values[at] = static_cast<float>(mask.is_bone[at] != 0 ? -capped : capped);
    }
    return {std::move(result), faces > 0 ? static_cast<double>(crossings) / static_cast<double>(faces) : 0.0};
}

}  // namespace kerf::bone
