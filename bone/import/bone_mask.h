// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "bone/image/voxel_image.h"

/// Which voxels of a scan are bone, and what may be done to that without asking the scan again.
namespace kerf {

/// Voxels beside each other over a face.
inline constexpr std::array<std::array<int, 3>, 6> face_neighbours{
    {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};

template <class Visit>  // visit(i, j, k, offset)
void for_each_voxel(const VoxelGrid& grid, const Visit& visit) {
    std::size_t at = 0;
    for (int k = 0; k < grid.size[2]; ++k)
        for (int j = 0; j < grid.size[1]; ++j)
            for (int i = 0; i < grid.size[0]; ++i) visit(i, j, k, at++);
}

/// Voxels that are bone, on the grid of `image`, which outlives it.
struct BoneMask {
    const VoxelImage& image;
    std::vector<std::uint8_t> is_bone;
    /// Voxels that belong to something else, and never become bone; empty: nothing does.
    std::vector<std::uint8_t> is_other = {};

    explicit BoneMask(const VoxelImage& of) : image(of), is_bone(of.values.size(), 0) {}

    /// Outside the grid there is no bone.
    [[nodiscard]] bool at(int i, int j, int k) const noexcept {
        return image.has(i, j, k) && is_bone[image.offset(i, j, k)] != 0;
    }
    [[nodiscard]] std::size_t count() const;
};

/// Leaves only the largest piece: what touches nothing was noise, or another bone. Returns how many there were.
int keep_largest(BoneMask& mask);

/// Leaves only the piece whose nearest voxel's centre is nearest to a place. Returns how far that one is [m]; nothing,
/// and nothing changes, if there is no bone.
std::optional<double> keep_nearest(BoneMask& mask, Vec3 place);

/// Every voxel within `radius` [m] of one that holds `value` holds it too. Growing and then shrinking closes gaps.
void spread(BoneMask& mask, bool value, double radius);

/// What no way over faces leads out of becomes bone.
void fill_cavities(BoneMask& mask);

/// Moves the border by at most one voxel to where the grey values cross the threshold.
void follow_grey(BoneMask& mask, double threshold);

}  // namespace kerf
