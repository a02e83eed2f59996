// SPDX-License-Identifier: Apache-2.0
#include "core/import/voxel_distance.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/field/growing_distance.h"

namespace kerf {
namespace {

/// Distance to a plane that crosses the axes at `ways` [m]; HUGE_VAL: it does not cross that one.
double distance_to_plane(const std::array<double, 3>& ways) {
    double sum = 0.0;
    for (const double way : ways) sum += 1.0 / (std::max(way, 1e-9) * std::max(way, 1e-9));
    return sum > 0.0 ? 1.0 / std::sqrt(sum) : HUGE_VAL;
}

/// Where the border crosses the line through eight voxels between the fourth and the fifth, as a share of the way. Either way round.
double crossing(const std::array<double, 8>& line, double threshold) {
    constexpr double blurred = 0.2;  // of all there is between bone and air: a border that takes so much in two voxels is not sharp
    const double here = line[3], there = line[4];
    const double share = (here - threshold) / (here - there);
    // What is whole say the voxels behind, as far as the next border leaves them whole. Not the larger of them and the border's own:
    // noise makes that larger than whole, and the border would lie towards the middle between two voxels.
    const double way = here > there ? 1.0 : -1.0;
    const auto whole_of = [&](double own, double next, double second, double third, double side) {
        const auto is_beyond = [&](double value) { return side * (value - threshold) < 0.0; };
        if (is_beyond(second)) return side * (own - next) > 0.0 ? own : next;
        return is_beyond(third) ? next : 0.5 * (next + second);
    };
    const double full = whole_of(here, line[2], line[1], line[0], way), empty = whole_of(there, line[5], line[6], line[7], -way);
    const double whole = full - empty;
    if (!(way * whole > 0.0)) return share;
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
            std::array<double, 8> line{0.0, 0.0, 0.0, here, there, 0.0, 0.0, 0.0};
            for (int step = 1; step <= 3; ++step) {  // beyond the image as at its end
                line[static_cast<std::size_t>(3 - step)] = value(-step, line[static_cast<std::size_t>(4 - step)]);
                line[static_cast<std::size_t>(4 + step)] = value(1 + step, line[static_cast<std::size_t>(3 + step)]);
            }
            const double share = crosses ? crossing(line, threshold) : 0.5;
            ways[n / 2] = std::min(ways[n / 2], share * spacing[n / 2]);
        }
        const double near = distance_to_plane(ways);
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

}  // namespace kerf
