// SPDX-License-Identifier: Apache-2.0
// Changes of bodies as one offer: what belongs to a body goes with its parts, and an undo gives it back.
#include "core/haptics/scene/bone_scene.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "tests/support/milled_bar.h"

namespace kerf {
namespace {

using namespace literals;

/// A wall 1 mm thick across the bar at x.
CutRecord wall_at(double x, std::uint64_t sequence) {
    CutRecord record;
    record.sequence = sequence;
    record.from = record.to = {{x, 0, 6.0_mm}, {1, 0, 0, 0}};
    return record;
}

/// A bar with one zone and one step, which the last of the parts inherits.
struct Bar {
    Body body = test::block({-7.0_mm, -1.5_mm, -1.5_mm}, {7.0_mm, 1.5_mm, 1.5_mm}, 0.25_mm);
    ToolSolid wall = ToolSolid::prism({{0.0, 0.5_mm}, {-12.0_mm, 0.5_mm}}, 12.0_mm);
    BoneScene scene{body, {&wall}};
    BodyStates body_states;

    Bar() {
        scene.find_pieces(1e-9, {.owners = {{0}, {0}},
                                 .inherit = [](Owners& owners, std::size_t from, const std::vector<std::size_t>& bodies,
                                               const PresentBone&) {
                                     for (auto* of : {&owners.zone, &owners.step})
                                         for (std::size_t& owner : *of)
                                             if (owner == from) owner = bodies.back();
                                 }});
    }
    void cut(const CutRecord& record) {
        scene.apply({&record, 1}, body_states);
        scene.end_cut();
    }
    /// As a loop would that takes everything over.
    void take(const Offer& offer) {
        scene.taken(offer, body_states, 100);
        body_states.count = offer.body_states.count;
    }
};

TEST(BoneScene, OffersASeparationWithTheOwnersAfterIt) {
    Bar bar;
    bar.cut(wall_at(3.0_mm, 0));
    ASSERT_NE(bar.scene.waiting(), nullptr);
    EXPECT_EQ(bar.scene.owners().zone, (std::vector<std::size_t>{0}));  // the loop does not know of it yet

    const Offer offer = bar.scene.separation();
    EXPECT_EQ(offer.change, Offer::Change::separation);
    EXPECT_EQ(offer.body_states.count, 2u);
    ASSERT_TRUE(offer.made[0].body != nullptr && offer.made[1].body != nullptr);
    EXPECT_EQ(offer.made[1].follows, 0);
    EXPECT_EQ(offer.owners.zone, (std::vector<std::size_t>{1}));

    bar.take(offer);
    EXPECT_EQ(bar.scene.waiting(), nullptr);
    EXPECT_EQ(bar.scene.owners().zone, (std::vector<std::size_t>{1}));
    EXPECT_EQ(bar.scene.owners().step, (std::vector<std::size_t>{1}));
}

TEST(BoneScene, OffersASeparationWithoutLaterOnes) {
    Bar bar;
    bar.cut(wall_at(3.0_mm, 0));
    const Offer before = bar.scene.separation();
    const CutRecord later = wall_at(-3.0_mm, 1);
    bar.cut(later);
    const CutRecord last = wall_at(0.0, 2);
    bar.cut(last);
    const Offer after = bar.scene.separation();
    for (const CutRecord* record : {&later, &last})
        static_cast<void>(before.made[0].body->committed.stamp(*record, bar.wall));
    EXPECT_TRUE(before.made[0].body->committed.same_bits(after.made[0].body->committed));
    EXPECT_FALSE(after.made[0].body->committed.same_bits(bar.scene.bone().cut(0)));  // which lacks the later parts
    EXPECT_EQ(after.body_states.count, 2u);

    bar.take(after);
    bar.take(bar.scene.separation());
    const Offer newest = bar.scene.separation();
    EXPECT_TRUE(newest.made[0].body->committed.same_bits(bar.scene.bone().cut(0)));
}

TEST(BoneScene, CutsAPartOfAWaitingPartByTheNameThatTheLoopKnows) {
    Bar bar;
    bar.cut(wall_at(1.0_mm, 0));  // the longer part stays body 0
    bar.cut(wall_at(4.0_mm, 1));
    ASSERT_EQ(bar.scene.bone().count(), 3u);
    ASSERT_EQ(bar.scene.bone().piece(2).separated_from, 1u);
    EXPECT_TRUE(bar.scene.bone().is_recorded_as(2, 0));  // the loop has body 0 alone
    bar.take(bar.scene.separation());
    EXPECT_TRUE(bar.scene.bone().is_recorded_as(2, 1));
    EXPECT_FALSE(bar.scene.bone().is_recorded_as(2, 0));
}

TEST(BoneScene, FindsOwnersInTheOrderOfTheCutsHoweverLateTheyAreTaken) {
    Bar at_once, late;
    at_once.cut(wall_at(3.0_mm, 0));
    at_once.take(at_once.scene.separation());
    at_once.cut(wall_at(-3.0_mm, 1));
    at_once.take(at_once.scene.separation());
    late.cut(wall_at(3.0_mm, 0));
    late.cut(wall_at(-3.0_mm, 1));
    late.take(late.scene.separation());
    late.take(late.scene.separation());
    EXPECT_EQ(late.scene.owners().zone, at_once.scene.owners().zone);
    EXPECT_EQ(late.scene.bone().hash(), at_once.scene.bone().hash());
}

TEST(BoneScene, GivesBackTheOwnersWithAnUndo) {
    Bar bar;
    bar.cut(wall_at(3.0_mm, 0));
    bar.take(bar.scene.separation());
    ASSERT_TRUE(bar.scene.can(HistoryChange::undo));
    bar.take(bar.scene.turn(HistoryChange::undo));
    EXPECT_EQ(bar.scene.owners().zone, (std::vector<std::size_t>{0}));
    EXPECT_EQ(bar.scene.bone().count(), 1u);
}

TEST(BoneScene, DoesNotChangeUntilItsOfferIsTaken) {
    Bar bar;
    const std::uint64_t before = bar.scene.bone().hash();
    const Offer offer = bar.scene.subtraction(0, {{0, 0, 6.0_mm}, {1, 0, 0, 0}}, bar.body_states);
    ASSERT_EQ(offer.subtracted.size(), 1u);
    EXPECT_EQ(bar.scene.bone().hash(), before);
    EXPECT_FALSE(bar.scene.can(HistoryChange::undo));
    EXPECT_NE(offer.made[0].body->committed.hash(), CutField(bar.body, 0).hash());
    bar.take(offer);
    EXPECT_NE(bar.scene.bone().hash(), before);
    EXPECT_TRUE(bar.scene.can(HistoryChange::undo));
}

TEST(Simulation, KeepsIdsInOrderWhereABodyComesInBeforeAPartIsTakenOver) {
    // Given a bar that the mill has just severed, so that the loop does not know its parts yet
    test::Milled milled;
    const Body metal = test::block({-1.0_mm, -1.0_mm, -1.0_mm}, {1.0_mm, 1.0_mm, 1.0_mm}, 0.2_mm);
    milled.simulation.find_pieces(1e-9);
    while (milled.x < 4.0_mm && milled.simulation.present().count() == 1) milled.go();
    ASSERT_EQ(milled.simulation.present().count(), 2u);
    ASSERT_EQ(milled.simulation.bodies().size(), 1u);
    // When metal comes in
    ASSERT_EQ(milled.simulation.insert(metal, {{50.0_mm, 0, 0}, {1, 0, 0, 0}}, false), "");
    // Then the part comes first, and each body is where its id says
    ASSERT_EQ(milled.simulation.bodies().size(), 3u);
    for (std::size_t b = 0; b < 3; ++b) EXPECT_EQ(milled.simulation.bodies()[b]->id, b);
    EXPECT_EQ(milled.simulation.bodies()[2]->bone, &metal);
    EXPECT_EQ(milled.simulation.present().piece(2).bone, &metal);
}

}  // namespace
}  // namespace kerf
