// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "bone/image/voxel_image.h"

/// The bone voxels of a scan, and operations on them.
namespace kerf::bone {

/// Offsets to the six neighbours of a voxel over its faces.
inline constexpr std::array<std::array<int, 3>, 6> face_neighbours{
    {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};

template <class Visit>  // visit(i, j, k, offset)
void for_each_voxel(const VoxelGrid& grid, const Visit& visit) {
    std::size_t at = 0;
    for (int k = 0; k < grid.size[2]; ++k)
        for (int j = 0; j < grid.size[1]; ++j)
            for (int i = 0; i < grid.size[0]; ++i) visit(i, j, k, at++);
}

/// The bone voxels on the grid of `image`, which outlives it.
struct BoneMask {
    const VoxelImage& image;
    std::vector<std::uint8_t> is_bone;
    /// Voxels of another structure, which never become bone; empty: none.
    std::vector<std::uint8_t> is_other = {};

    explicit BoneMask(const VoxelImage& of) : image(of), is_bone(of.values.size(), 0) {}

    /// Returns whether a voxel is bone; false outside the grid.
    [[nodiscard]] bool at(int i, int j, int k) const noexcept {
        return image.has(i, j, k) && is_bone[image.offset(i, j, k)] != 0;
    }
    [[nodiscard]] std::size_t count() const;
};

/// Bone voxels that are connected over faces.
struct BonePiece {
    std::size_t voxels = 0;
    std::array<int, 3> first{};    ///< one of its voxels
    bool is_at_grid_face = false;  ///< the bone may continue beyond the grid
};

/// Returns the pieces, largest first.
[[nodiscard]] std::vector<BonePiece> bone_pieces(const BoneMask& mask);

/// Keeps only the largest piece; smaller ones are noise or another bone. Returns the number of pieces.
int keep_largest(BoneMask& mask);

/// Keeps only the piece with the voxel centre nearest to a point. Returns the distance of this centre [m]. Without
/// bone, returns nothing and changes nothing.
std::optional<double> keep_nearest(BoneMask& mask, Vec3 point);

/// Sets every voxel within `radius` [m] of a voxel with `value` to `value`. Growing and then shrinking closes gaps.
void spread(BoneMask& mask, bool value, double radius);

/// Fills cavities that are not connected to the outside over faces.
void fill_cavities(BoneMask& mask);

/// Moves the border by at most one voxel to where the grey values cross the threshold. Each piece of bone remains one
/// piece: crumbs that come off are removed.
void follow_grey(BoneMask& mask, double threshold);

}  // namespace kerf::bone
