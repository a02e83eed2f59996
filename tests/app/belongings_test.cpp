// SPDX-License-Identifier: Apache-2.0
#include "app/belongings.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "kerf/units.hpp"
#include "tests/support/block.h"

namespace kerf {
namespace {

using namespace literals;

/// A wall 1 mm thick across the block at x.
CutRecord wall_at(double x) {
    CutRecord record;
    record.from = record.to = {{x, 0, 6.0_mm}, {1, 0, 0, 0}};
    return record;
}

TEST(Belongings, PartsOfTheBoneAreWhatCameOffItAndNotWhatWasPutIn) {
    const Body bar = test::block({-7.0_mm, -1.5_mm, -1.5_mm}, {7.0_mm, 1.5_mm, 1.5_mm}, 0.25_mm);
    const Body metal = test::block({-1.0_mm, -1.0_mm, -1.0_mm}, {1.0_mm, 1.0_mm, 1.0_mm}, 0.25_mm);
    const ToolSolid wall = ToolSolid::prism({{0.0, 0.5_mm}, {-12.0_mm, 0.5_mm}}, 12.0_mm);
    PresentBone bone(bar, 512);
    bone.look_for_pieces(1e-9);
    EXPECT_EQ(parts_of_the_bone(bone), (std::vector<std::size_t>{0}));

    // An implant comes in, then the bone is cut twice: what came off is a part once the loop has it
    ASSERT_EQ(bone.add(metal), 1);
    auto first = bone.apply(wall_at(3.0_mm), wall);
    ASSERT_EQ(first.size(), 1u);
    EXPECT_EQ(parts_of_the_bone(bone), (std::vector<std::size_t>{0}));
    bone.adopted(first[0]);
    EXPECT_EQ(parts_of_the_bone(bone), (std::vector<std::size_t>{0, 2}));
    auto second = bone.apply(wall_at(-3.0_mm), wall);
    ASSERT_EQ(second.size(), 1u);
    bone.adopted(second[0]);
    EXPECT_EQ(parts_of_the_bone(bone), (std::vector<std::size_t>{0, 2, 3}));
}

}  // namespace
}  // namespace kerf
