// SPDX-License-Identifier: Apache-2.0
#include "bone/import/voxel_density.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "bone/import/bone_mask.h"
#include "bone/report/import_report.h"

namespace kerf::bone {
namespace {

/// Sets every voxel that is not `known` to the mean of its known neighbours, layer by layer outwards.
void extend(VoxelImage& image, std::vector<std::uint8_t> known) {
    std::vector<std::array<int, 3>> front, next;
    const auto has_unknown_neighbour = [&](int i, int j, int k, const auto& visit) {
        for (const auto& [x, y, z] : face_neighbours)
            if (image.has(i + x, j + y, k + z) && known[image.offset(i + x, j + y, k + z)] == 0)
                visit(i + x, j + y, k + z);
    };
    constexpr std::uint8_t is_known = 1, is_next = 2;
    const auto visit_neighbours = [&](int i, int j, int k) {
        has_unknown_neighbour(i, j, k, [&](int x, int y, int z) {
            known[image.offset(x, y, z)] = is_next;
            next.push_back({x, y, z});
        });
    };
    for_each_voxel(image, [&](int i, int j, int k, std::size_t at) {
        if (known[at] == is_known) visit_neighbours(i, j, k);
    });
    while (!next.empty()) {
        front.swap(next);
        next.clear();
        for (const auto& [i, j, k] : front) {
            double sum = 0.0, count = 0.0;
            for (const auto& [x, y, z] : face_neighbours) {
                if (!image.has(i + x, j + y, k + z) || known[image.offset(i + x, j + y, k + z)] != is_known) continue;
                sum += static_cast<double>(image.at(i + x, j + y, k + z));
                count += 1.0;
            }
            image.values[image.offset(i, j, k)] = static_cast<float>(sum / count);
        }
        for (const auto& [i, j, k] : front) known[image.offset(i, j, k)] = is_known;
        for (const auto& [i, j, k] : front) visit_neighbours(i, j, k);
    }
}

}  // namespace

std::optional<VoxelImage> densities_in_voxels(const VoxelImage& scan, const VoxelImage& distance, double cortex,
                                              const documents::DensityLine& line, std::vector<std::string>& notes) {
    double sum = 0.0, count = 0.0, smallest = HUGE_VAL, largest = -HUGE_VAL;
    VoxelImage density = scan;
    std::vector<std::uint8_t> known(scan.values.size(), 0);
    for (std::size_t at = 0; at < scan.values.size(); ++at) {
        if (static_cast<double>(distance.values[at]) >= -cortex) continue;
        known[at] = 1;
        const double by_line = line.at_zero + line.per_unit * static_cast<double>(scan.values[at]);
        const double here = std::max(line.floor, by_line);
        density.values[at] = static_cast<float>(here);
        sum += here;
        count += 1.0;
        smallest = std::min(smallest, here);
        largest = std::max(largest, here);
    }
    const auto g_per_cm3 = [](double density_si, int digits) { return rounded(density_si * 1e-3, digits); };
    std::string note = "Density of the innermost tissue: " + g_per_cm3(line.at_zero, 2) + " + " +
                       g_per_cm3(line.per_unit, 6) + " × value g/cm3, at least " + g_per_cm3(line.floor, 2) +
                       " g/cm3; ";
    note += count > 0.0 ? "by voxel, mean " + g_per_cm3(sum / count, 2) + ", from " + g_per_cm3(smallest, 2) + " to " +
                              g_per_cm3(largest, 2) + " g/cm3."
                        : "the same everywhere, as no voxel is deeper than the cortex.";
    notes.push_back(line.source.empty() ? note : note + " Source: " + line.source);
    if (count == 0.0) return std::nullopt;
    extend(density, std::move(known));
    return density;
}

}  // namespace kerf::bone
