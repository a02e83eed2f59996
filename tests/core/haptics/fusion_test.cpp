// SPDX-License-Identifier: Apache-2.0
// Which pieces grow together where several are in reach.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/haptics/scene/bone_scene.h"
#include "tests/support/block.h"

namespace kerf {
namespace {

using namespace literals;

/// A cube of 4 mm, held, and others around it.
struct Pieces {
    Body cube = test::block({-2.0_mm, -2.0_mm, -2.0_mm}, {2.0_mm, 2.0_mm, 2.0_mm}, 0.4_mm, {0.3, 0.1, 0.7});
    ToolSolid tool = test::drill_outline(1.0_mm, 60.0_deg, 10.0_mm);
    BoneScene scene{cube, {&tool}};
    BodyStates states;

    /// Adds a cube at `gap` from the held one, on its side `towards`. Returns its id.
    std::size_t add(Vec3 towards, double gap, bool is_cuttable = true) {
        std::string why_not;
        const Pose there{(4.0_mm + gap) * towards, {1, 0, 0, 0}};
        const Offer offer = scene.insertion(cube, there, is_cuttable, states, why_not);
        EXPECT_EQ(why_not, "");
        scene.taken(offer, states, 100);
        states = offer.body_states;
        return states.count - 1;
    }
    /// The groups of all bodies after the held one has grown to another.
    [[nodiscard]] std::vector<std::uint16_t> groups_after_fusion() {
        std::string why_not;
        const Offer offer = scene.fusion(0, states, why_not);
        EXPECT_EQ(why_not, "");
        std::vector<std::uint16_t> groups;
        for (std::size_t b = 0; b < offer.body_states.count; ++b) groups.push_back(offer.body_states.of[b].group);
        return groups;
    }
};

using Groups = std::vector<std::uint16_t>;
constexpr Vec3 left{1, 0, 0}, front{0, -1, 0};

TEST(Fusion, JoinsTheNearestPieceWhicheverCameFirst) {
    Pieces near_first, near_last;
    near_first.add(front, 0.4_mm);
    near_first.add(left, 1.2_mm);
    EXPECT_EQ(near_first.groups_after_fusion(), (Groups{0, 0, 2, 0}));
    near_last.add(left, 1.2_mm);
    near_last.add(front, 0.4_mm);
    EXPECT_EQ(near_last.groups_after_fusion(), (Groups{0, 1, 0, 0}));
}

TEST(Fusion, JoinsAllThatIsFusedToTheNearestPiece) {
    // Given two pieces that are fused to each other, the nearer of which came last
    Pieces pieces;
    pieces.add(left, 50.0_mm);
    pieces.add(left, 1.2_mm);
    pieces.add(front, 0.4_mm);
    pieces.states.of[3].group = 1;
    EXPECT_EQ(pieces.groups_after_fusion(), (Groups{0, 0, 2, 0, 0}));
}

TEST(Fusion, PassesOverMetalAndPiecesThatAreRemoved) {
    Pieces pieces;
    pieces.add(front, 0.3_mm, false);
    pieces.states.of[pieces.add(-left, 0.5_mm)].is_present = false;
    pieces.add(left, 1.2_mm);
    EXPECT_EQ(pieces.groups_after_fusion(), (Groups{0, 1, 2, 0, 0}));
}

TEST(Fusion, GrowsInTheFrameOfTheHeldPiece) {
    Pieces pieces;
    pieces.add(front, 0.4_mm);
    const Pose both{{0.1, 0.2, 0.3}, quat_from_rotation_vector({0.3, 0.9, -0.4})};
    for (std::size_t b = 0; b < 2; ++b)
        pieces.states.of[b].world_from_body = both * pieces.states.of[b].world_from_body;
    std::string why_not;
    const Offer offer = pieces.scene.fusion(0, pieces.states, why_not);
    ASSERT_TRUE(offer.is_any()) << why_not;
    EXPECT_TRUE(offer.body_states.of[2].world_from_body.position == both.position);
    // The middle of the gap is bone, that of the cube is not
    const Body& bridge = *offer.added;
    EXPECT_LT(uncut_distance(bridge, locate(bridge, {0, -2.2_mm, 0})), 0.0);
    EXPECT_GT(uncut_distance(bridge, locate(bridge, {0, -1.0_mm, 0})), 0.0);
}

// ---- undo and redo -------------------------------------------------------------------------------------------------

TEST(BoneScene, AnotherChangeDropsWhatWasUndone) {
    Pieces pieces;
    pieces.add(front, 1.0_mm);
    const Offer undo = pieces.scene.turn(HistoryChange::undo);
    pieces.scene.taken(undo, pieces.states, 100);
    pieces.states = undo.body_states;
    ASSERT_TRUE(pieces.scene.can(HistoryChange::redo));
    pieces.add(left, 1.0_mm);
    EXPECT_FALSE(pieces.scene.can(HistoryChange::redo));
}

TEST(BoneScene, DropsTheOldestOfTooManySteps) {
    // Given twenty cuts, each through another part of the cube
    Pieces pieces;
    std::vector<double> removed{0.0};
    for (int cut = 0; cut < 20; ++cut) {
        CutRecord record;
        record.sequence = static_cast<std::uint64_t>(cut);
        record.from = record.to = {{-1.5_mm + 0.15_mm * cut, -1.0_mm, 0}, {1, 0, 0, 0}};
        pieces.scene.apply({&record, 1}, pieces.states);
        pieces.scene.end_cut();
        removed.push_back(pieces.scene.bone().removed());
        ASSERT_GT(removed.back(), removed[static_cast<std::size_t>(cut)]);
    }

    // When all that can be undone is undone
    std::size_t steps = 0;
    for (; pieces.scene.can(HistoryChange::undo); ++steps) {
        const Offer undo = pieces.scene.turn(HistoryChange::undo);
        pieces.scene.taken(undo, pieces.states, 100);
        ASSERT_EQ(pieces.scene.bone().removed(), removed[19 - steps]) << steps;
    }

    // Then the first four stay
    EXPECT_EQ(steps, BoneScene::max_undo);
    EXPECT_EQ(pieces.scene.bone().removed(), removed[4]);
}

}  // namespace
}  // namespace kerf
