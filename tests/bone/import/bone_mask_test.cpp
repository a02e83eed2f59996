// SPDX-License-Identifier: Apache-2.0
#include "bone/import/bone_mask.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace kerf::bone {
namespace {

/// A slice of voxels, row by row. '#': bright bone; 'o': dark bone; '+': bright, no bone; '.': dark, no bone.
VoxelImage grey_of(const std::vector<std::string>& rows) {
    VoxelImage image;
    image.size = {static_cast<int>(rows.front().size()), static_cast<int>(rows.size()), 3};
    image.place({1e-3, 0, 0, 0, 0, 1e-3, 0, 0, 0, 0, 1e-3, 0});
    for (int k = 0; k < 3; ++k)
        for (const std::string& row : rows)
            for (const char voxel : row)
                image.values.push_back(k == 1 && (voxel == '#' || voxel == '+') ? 500.0f : 0.0f);
    return image;
}

BoneMask mask_of(const VoxelImage& image, const std::vector<std::string>& rows) {
    BoneMask mask(image);
    for_each_voxel(image, [&](int i, int j, int k, std::size_t at) {
        const char voxel = rows[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)];
        mask.is_bone[at] = k == 1 && (voxel == '#' || voxel == 'o') ? 1 : 0;
    });
    return mask;
}

std::vector<std::string> drawn(const BoneMask& mask) {
    std::vector<std::string> rows;
    for (int j = 0; j < mask.image.size[1]; ++j) {
        rows.emplace_back();
        for (int i = 0; i < mask.image.size[0]; ++i) rows.back() += mask.at(i, j, 1) ? '#' : '.';
    }
    return rows;
}

TEST(BoneMask, FollowsGreyWithoutCrumbs) {
    // The dark voxel has bright bone behind it, so it becomes air. The bright voxel beyond it would be left alone.
    const std::vector<std::string> rows{".....", ".###.", ".##o#", "....."};
    const VoxelImage image = grey_of(rows);
    BoneMask mask = mask_of(image, rows);
    follow_grey(mask, 250.0);
    EXPECT_EQ(drawn(mask), (std::vector<std::string>{".....", ".###.", ".##..", "....."}));
}

TEST(BoneMask, FollowsGreyOfEachPieceAlone) {
    const std::vector<std::string> rows{".......", ".##+.#.", ".##..#.", "......."};
    const VoxelImage image = grey_of(rows);
    BoneMask mask = mask_of(image, rows);
    follow_grey(mask, 250.0);
    EXPECT_EQ(drawn(mask), (std::vector<std::string>{".......", ".###.#.", ".##..#.", "......."}));
}

TEST(BoneMask, ListsItsPiecesLargestFirst) {
    const std::vector<std::string> rows{".......", ".##..#.", ".##....", ".......", "####..."};
    const VoxelImage image = grey_of(rows);
    const std::vector<BonePiece> pieces = bone_pieces(mask_of(image, rows));
    ASSERT_EQ(pieces.size(), 3u);
    EXPECT_EQ(pieces[0].voxels, 4u);
    EXPECT_FALSE(pieces[0].is_at_grid_face);
    EXPECT_EQ(pieces[0].first, (std::array<int, 3>{1, 1, 1}));
    EXPECT_EQ(pieces[1].voxels, 4u);
    EXPECT_TRUE(pieces[1].is_at_grid_face);
    EXPECT_EQ(pieces[2].voxels, 1u);
}

}  // namespace
}  // namespace kerf::bone
