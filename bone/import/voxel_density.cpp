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
#include "documents/read_anatomy.h"
#include "kerf/units.hpp"

namespace kerf::bone {
namespace {

using namespace literals;

constexpr double max_density = 3.0_g_per_cm3;  // as of a written density

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

std::string g_per_cm3(double density, int digits) { return rounded(density * 1e-3, digits); }

/// The densities in deep voxels.
struct Densities {
    double sum = 0.0, smallest = HUGE_VAL, largest = -HUGE_VAL;
    double largest_by_line = -HUGE_VAL;
    std::size_t count = 0, raised = 0, lowered = 0;  ///< [voxels] all; raised to the floor; lowered to the maximum

    double add(double by_line, double floor) {
        const double here = std::clamp(by_line, floor, max_density);
        ++count;
        if (by_line < floor) ++raised;
        if (by_line > max_density) ++lowered;
        sum += here;
        smallest = std::min(smallest, here);
        largest = std::max(largest, here);
        largest_by_line = std::max(largest_by_line, by_line);
        return here;
    }
};

/// Returns the volume of this many voxels, as in "240 mm3".
std::string volume_text(const VoxelImage& image, std::size_t voxels) {
    const double one = std::abs(dot(image.step(0), cross(image.step(1), image.step(2))));
    const double volume = static_cast<double>(voxels) * one * 1e9;
    return rounded(volume, volume < 10.0 ? 2 : 0) + " mm3";
}

std::string range_note(const VoxelImage& image, const documents::DensityLine& line, const Densities& found) {
    std::string note = "Density of the innermost tissue: " + g_per_cm3(line.at_zero, 2) + " + " +
                       g_per_cm3(line.per_unit, 6) + " × value g/cm3, at least " + g_per_cm3(line.floor, 2) +
                       " g/cm3; ";
    note += found.count > 0
                ? "by voxel, mean " + g_per_cm3(found.sum / static_cast<double>(found.count), 2) + ", from " +
                      g_per_cm3(found.smallest, 2) + " to " + g_per_cm3(found.largest, 2) + " g/cm3."
                : "the same everywhere, as no voxel is deeper than the cortex.";
    if (found.raised > 0) note += " It was raised to the floor in " + volume_text(image, found.raised) + ".";
    return line.source.empty() ? note : note + " Source: " + line.source;
}

/// Returns what makes the densities doubtful, one sentence or two each.
std::vector<std::string> doubts(const VoxelImage& image, const documents::DensityLine& line, const Densities& found) {
    std::vector<std::string> all;
    if (found.lowered > 0)
        all.push_back("The density line gives up to " + g_per_cm3(found.largest_by_line, 2) +
                      " g/cm3, expected at most " + g_per_cm3(max_density, 2) + " g/cm3. The density was lowered to " +
                      g_per_cm3(max_density, 2) + " g/cm3 in " + volume_text(image, found.lowered) +
                      ". Check the line, and the scan for metal.");
    if (line.per_unit < 0.0)
        all.push_back("The density falls as the value rises: got " + g_per_cm3(line.per_unit, 6) +
                      " g/cm3 per unit. Bone is what is brighter than the threshold. Check the sign of `per_unit`.");
    if (found.count == 0) return all;
    const bool is_constant = line.per_unit == 0.0;
    if (is_constant || found.raised == found.count || found.lowered == found.count)
        all.push_back("The density does not depend on the scan: got " + g_per_cm3(found.smallest, 2) +
                      " g/cm3 everywhere, " +
                      (is_constant        ? "as `per_unit` is 0"
                       : found.raised > 0 ? "the floor"
                                          : "the maximum") +
                      ". Check the line, or write the tissue's `density:`.");
    return all;
}

}  // namespace

std::optional<VoxelImage> densities_in_voxels(const VoxelImage& scan, const VoxelImage& distance, double cortex,
                                              const documents::Anatomy& anatomy, std::vector<std::string>& notes,
                                              text::Diagnostics& diagnostics) {
    const documents::DensityLine& line = *anatomy.ct->density;
    Densities found;
    VoxelImage density = scan;
    std::vector<std::uint8_t> known(scan.values.size(), 0);
    for (std::size_t at = 0; at < scan.values.size(); ++at) {
        if (static_cast<double>(distance.values[at]) >= -cortex) continue;
        known[at] = 1;
        const double by_line = line.at_zero + line.per_unit * static_cast<double>(scan.values[at]);
        density.values[at] = static_cast<float>(found.add(by_line, line.floor));
    }
    notes.push_back(range_note(scan, line, found));
    for (std::string& doubt : doubts(scan, line, found)) {
        diagnostics.push_back(text::warning_at(documents::in_anatomy(anatomy, {"ct", "density"}), "W0675", doubt));
        notes.push_back(std::move(doubt));
    }
    if (found.count == 0) return std::nullopt;
    extend(density, std::move(known));
    return density;
}

}  // namespace kerf::bone
