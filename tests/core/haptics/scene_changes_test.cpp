// SPDX-License-Identifier: Apache-2.0
// Forceps hold a piece of bone: it goes with them, and other bone stops it. Pieces grow together, others come in. And
// what was cut can be taken back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "core/plugin/core_instruments.h"
#include "tests/support/loop_guard.h"
#include "tests/support/made_outline.h"
#include "tests/support/mill.h"

namespace kerf {
namespace {

using namespace literals;

ToolSetup forceps() {
    const kerf_entry& core = core_instruments();
    ToolSetup setup;
    for (std::uint32_t i = 0; i < core.component_count; ++i) {
        const kerf_component& c = core.components[i];
        (c.kind == KERF_KIND_TOOL ? setup.tool : setup.force) = &c;
        for (std::uint32_t p = 0; p < c.param_count; ++p) setup.force_parameters.push_back(c.params[p].def);
    }
    setup.drives = {0.0};
    return setup;
}

/// The bar of the mill, and forceps beside the mill.
struct Bench {
    static constexpr double in_bone = 5.0_um, in_air = 100.0_um;  // a tick
    Body body = test::bar(0.2_mm);
    std::vector<Tool> tools{{test::mill(), test::outline(test::mill())}, {forceps(), test::outline(forceps())}};
    Simulation simulation{body, tools, gains_for(*find_device("premium-1.5-6dof"), 0.1), test::mill_at(-4.0_mm)};
    Pose hand = test::mill_at(-4.0_mm);
    TickResult last;

    Bench() { simulation.find_pieces(1e-9 /* 1 mm³ */); }

    /// In a straight line.
    void go_to(Vec3 to, double step = in_bone) {
        const Vec3 from = hand.position;
        const int ticks = std::max(1, static_cast<int>(length(to - from) / step));
        for (int i = 1; i <= ticks; ++i) {
            hand.position = from + (static_cast<double>(i) / ticks) * (to - from);
            last = simulation.tick({hand});
        }
    }
    void wait(int ticks) {
        for (int i = 0; i < ticks; ++i) {
            last = simulation.tick({hand});
        }
    }
    /// Through the bar at `y` and back into the air behind it.
    void sever(double y) {
        go_to({-4.0_mm, y, 6.0_mm}, in_air);
        go_to({4.0_mm, y, 6.0_mm});
        wait(30);
    }
    /// Forceps on the end that came off, from below.
    void grasp_the_end() {
        go_to({20.0_mm, 5.0_mm, 6.0_mm}, in_air);
        simulation.take_tool(1);
        go_to({20.0_mm, 5.0_mm, -6.0_mm}, in_air);
        go_to({0.0_mm, 5.0_mm, -6.0_mm}, in_air);
        go_to({0.0_mm, 5.0_mm, -1.6_mm});
        simulation.command_drive(0, 1.0);
        wait(2);
    }
    [[nodiscard]] Vec3 place_of(std::size_t b) const { return simulation.bodies()[b]->world_from_body.position; }
};

TEST(BodiesView, ManyPointsAreAskedOfEveryPieceEachItsWay) {
    // Given the mill back in the slot between two pieces, on its way into one of them, and more points about it than
    // are asked at a time
    Bench bench;
    bench.sever(2.0_mm);
    bench.go_to({0.0_mm, 2.0_mm, 6.0_mm}, Bench::in_air);
    bench.go_to({0.0_mm, 2.3_mm, 6.0_mm});
    ASSERT_EQ(bench.simulation.bodies().size(), 2u);
    std::vector<Vec3> points, ways;
    for (int n = 0; n < 300; ++n) {
        const double angle = 0.7 * n, r = n % 3 == 0 ? 1.2_mm : 0.5_mm + 0.0005_mm * (n % 200);
        points.push_back({r * std::cos(angle), r * std::sin(angle), -7.0_mm + 0.008_mm * n});
        ways.push_back(normalized(Vec3{std::sin(0.3 * n), std::cos(0.3 * n), n % 2 == 0 ? 0.5 : -0.5}));
    }
    const auto count = static_cast<std::uint32_t>(points.size());
    // When all are asked at once
    const kerf_bone_query& query = bench.simulation.bone().query();
    std::vector<kerf_bone_sample> together(count);
    query.sample(query.bone, points.data(), count, ways.data(), count, together.data());
    // Then each is answered as it is alone, from both pieces
    std::set<std::int32_t> bodies;
    double farthest = 0.0, farthest_in_second_block = 0.0;  // of the second body, behind a block of 256 points
    for (std::uint32_t n = 0; n < count; ++n) {
        kerf_bone_sample alone;
        query.sample(query.bone, &points[n], 1, &ways[n], 1, &alone);
        EXPECT_EQ(alone.engagement, together[n].engagement) << n;
        EXPECT_EQ(alone.gap, together[n].gap) << n;
        EXPECT_EQ(alone.body, together[n].body) << n;
        bodies.insert(alone.body);
        farthest = std::max(farthest, alone.gap);
        if (n >= 256 && alone.body == 1) farthest_in_second_block = std::max(farthest_in_second_block, alone.gap);
    }
    EXPECT_TRUE(bodies.contains(0) && bodies.contains(1));
    EXPECT_GT(farthest, 0.0);
    EXPECT_GT(farthest_in_second_block, 0.0);
}

TEST(BodiesView, OfTwoBodiesAtOnePointTheFirstAnswers) {
    Bench bench;
    const Body twin = bench.body;
    ASSERT_EQ(bench.simulation.insert(twin, identity_pose(), true), "");
    bench.go_to({-2.5_mm, 2.0_mm, 6.0_mm}, Bench::in_air);
    const Vec3 point = inverse(bench.simulation.world_from_tool()) * Vec3{-1.0_mm, 2.0_mm, 0}, along{1, 0, 0};
    const kerf_bone_query& query = bench.simulation.bone().query();
    kerf_bone_sample sample;
    query.sample(query.bone, &point, 1, &along, 1, &sample);
    EXPECT_EQ(sample.engagement, 1.0);
    EXPECT_EQ(sample.body, 0);
    kerf_surface_point nearest;
    query.nearest(query.bone, &point, 1, &nearest);
    EXPECT_EQ(nearest.body, 0);
}

TEST(HeldBody, GoesWithTheForcepsUntilTheyOpen) {
    Bench bench;
    bench.sever(2.0_mm);
    ASSERT_EQ(bench.simulation.bodies().size(), 2u);
    bench.grasp_the_end();
    ASSERT_EQ(bench.simulation.held(), 1);

    bench.go_to({3.0_mm, 9.0_mm, -11.6_mm});
    const Vec3 moved = bench.place_of(1);
    EXPECT_NEAR(moved.x, 3.0_mm, 0.1_mm);
    EXPECT_NEAR(moved.y, 4.0_mm, 0.1_mm);
    EXPECT_NEAR(moved.z, -10.0_mm, 0.1_mm);
    EXPECT_EQ(length(bench.place_of(0)), 0.0);

    bench.simulation.command_drive(0, 0.0);
    bench.wait(2);
    EXPECT_EQ(bench.simulation.held(), -1);
    const Vec3 left = bench.place_of(1);
    bench.go_to({3.0_mm, 9.0_mm, -16.0_mm});
    EXPECT_EQ(length(bench.place_of(1) - left), 0.0);
}

TEST(HeldBody, IsStoppedByTheStump) {
    // Given the end in the forceps, 1.2 mm from the stump: the mill's width
    Bench bench;
    bench.sever(2.0_mm);
    bench.grasp_the_end();
    ASSERT_EQ(bench.simulation.held(), 1);
    EXPECT_LT(length(linear(bench.last.coupled_on_hand)), 0.5);
    // When the hand pushes it 3 mm towards it
    bench.go_to({0.0_mm, 2.0_mm, -1.6_mm});
    bench.wait(50);
    // Then face meets face, and the hand feels the stretch of its coupling
    EXPECT_NEAR(bench.place_of(1).y, -1.2_mm, 0.1_mm);
    EXPECT_GT(linear(bench.last.coupled_on_hand).y, 1.0);
    // and drawn back the force is gone
    bench.go_to({0.0_mm, 5.0_mm, -1.6_mm});
    bench.wait(50);
    EXPECT_LT(length(linear(bench.last.coupled_on_hand)), 0.1);
}

TEST(HeldBody, IsStoppedByItsCornersWhenTurned) {
    // Given the end turned by 45 degrees about its length, so that its corners stand beside the stump's face
    Bench bench;
    bench.sever(2.0_mm);
    bench.grasp_the_end();
    const Quat turned = quat_from_rotation_vector({0, 0.25 * pi, 0});
    for (int i = 1; i <= 2000; ++i) {
        bench.hand.rotation = quat_from_rotation_vector({0, 0.25 * pi * i / 2000.0, 0});
        bench.wait(1);
    }
    EXPECT_NEAR(bench.simulation.world_from_tool().rotation.y, turned.y, 0.01);
    bench.go_to({0.0_mm, 2.0_mm, -1.6_mm});
    bench.wait(50);
    EXPECT_NEAR(bench.place_of(1).y + 1.2_mm, 0.0, 0.15_mm);
    EXPECT_GT(linear(bench.last.coupled_on_hand).y, 1.0);
}

TEST(HeldBody, StaysInTheForcepsWhileItIsShown) {
    Bench bench;
    bench.sever(2.0_mm);
    bench.grasp_the_end();
    bench.simulation.show_body(1, true);
    EXPECT_EQ(bench.simulation.held(), 1);
    bench.simulation.show_body(0, false);
    EXPECT_EQ(bench.simulation.held(), 1) << "it is another body";
    bench.simulation.show_body(1, false);
    EXPECT_EQ(bench.simulation.held(), -1);
}

TEST(HeldBody, IsTheGrippedOneAlsoAfterAPieceFusedToItWasPlaced) {
    Bench bench;
    bench.sever(2.0_mm);
    bench.grasp_the_end();
    ASSERT_EQ(bench.simulation.fuse(), "");
    bench.simulation.place_body(0, {{0, 0, 1.0_mm}, {1, 0, 0, 0}});
    EXPECT_EQ(bench.simulation.held(), 1);
}

TEST(HeldBody, IsStoppedAgainAfterItWasPutDownAndGrippedOnceMore) {
    Bench bench;
    bench.sever(2.0_mm);
    bench.grasp_the_end();
    for (int time = 0; time < 2; ++time) {
        ASSERT_EQ(bench.simulation.held(), 1) << time;
        bench.go_to({0.0_mm, 2.0_mm, -1.6_mm});
        bench.wait(50);
        EXPECT_NEAR(bench.place_of(1).y, -1.2_mm, 0.1_mm) << time;
        EXPECT_GT(linear(bench.last.coupled_on_hand).y, 1.0) << time;
        bench.go_to({0.0_mm, 5.0_mm, -1.6_mm});
        bench.simulation.command_drive(0, 0.0);
        bench.wait(2);
        ASSERT_EQ(bench.simulation.held(), -1) << time;
        bench.simulation.command_drive(0, 1.0);
        bench.wait(2);
    }
}

TEST(Separation, LeavesAPieceOfARemovedBodyRemoved) {
    // Given a bar that is severed, and removed before the loop knows of its parts
    Bench bench;
    bench.go_to({-4.0_mm, 2.0_mm, 6.0_mm}, Bench::in_air);
    while (bench.simulation.present().count() == 1) bench.go_to(bench.hand.position + Vec3{Bench::in_bone, 0, 0});
    ASSERT_EQ(bench.simulation.bodies().size(), 1u);
    bench.simulation.show_body(0, false);
    bench.wait(30);
    ASSERT_EQ(bench.simulation.bodies().size(), 2u);
    for (const auto& body : bench.simulation.bodies()) EXPECT_FALSE(body->is_present) << body->id;
}

TEST(HeldBody, NothingIsHeldWhereThereIsNoBone) {
    Bench bench;
    bench.sever(2.0_mm);
    bench.go_to({20.0_mm, 5.0_mm, 6.0_mm}, Bench::in_air);
    bench.simulation.take_tool(1);
    bench.simulation.command_drive(0, 1.0);
    bench.wait(1);
    EXPECT_EQ(bench.simulation.held(), -1);
    ASSERT_EQ(bench.last.event_count, 1u);
    EXPECT_STREQ(bench.last.events[0], "kerf.core.closed_on_nothing");
}

TEST(HeldBody, AWholeBoneIsNotTaken) {
    Bench bench;
    bench.go_to({-4.0_mm, 12.0_mm, 6.0_mm}, Bench::in_air);
    bench.grasp_the_end();
    EXPECT_EQ(bench.simulation.held(), -1);
    bench.go_to({0.0_mm, 5.0_mm, -6.0_mm}, Bench::in_air);
    EXPECT_EQ(length(bench.place_of(0)), 0.0);
}

TEST(HeldBody, HoldingNeitherAllocatesNorLocks) {
    Bench bench;
    bench.sever(2.0_mm);
    bench.grasp_the_end();
    ASSERT_EQ(bench.simulation.held(), 1);
    bench.go_to({0.0_mm, 4.0_mm, -1.6_mm});
    for (int i = 0; i < 300; ++i) {
        bench.hand.position.y -= 5.0_um;
        const test::Forbidden before = test::forbidden_here();
        bench.last = bench.simulation.loop().tick({bench.hand});
        EXPECT_EQ(test::forbidden_here(), before);
        bench.simulation.follow();
    }
    EXPECT_GT(linear(bench.last.coupled_on_hand).y, 0.1);
}

TEST(Fuse, ABridgeGrowsAndThePiecesGoTogether) {
    Bench bench;
    bench.sever(2.0_mm);
    bench.grasp_the_end();
    ASSERT_EQ(bench.simulation.held(), 1);
    const double before = bench.simulation.present().removed();
    EXPECT_EQ(bench.simulation.fuse(), "");
    ASSERT_EQ(bench.simulation.bodies().size(), 3u);
    // It fills the slot of 1.2 mm between faces of 9 mm², and bulges a little; nothing of the bone is gone for it
    const double gap = 1.2 * 9e-9, volume = bone_volume(*bench.simulation.bodies()[2]->bone, bench.simulation.exact(2));
    EXPECT_GT(volume, 0.97 * gap);
    EXPECT_LT(volume, 1.5 * gap);
    EXPECT_EQ(bench.simulation.present().removed(), before);
    EXPECT_EQ(bench.simulation.present().added(), volume);
    // All three go where the forceps go, and nothing stops them
    const Vec3 apart = bench.place_of(1) - bench.place_of(0);
    bench.go_to({3.0_mm, 5.0_mm, -6.0_mm}, Bench::in_air);
    bench.wait(50);
    EXPECT_NEAR(length(bench.place_of(1) - bench.place_of(0) - apart), 0.0, 1e-9);
    EXPECT_NEAR(length(bench.place_of(1) - bench.place_of(2)), 0.0, 1e-9);
    EXPECT_NEAR(bench.place_of(0).x, 3.0_mm, 0.1_mm);
    EXPECT_LT(length(linear(bench.last.coupled_on_hand)), 0.5);
    // and taken back, there are two again, where they were
    bench.simulation.command_drive(0, 0.0);
    bench.go_to({20.0_mm, 5.0_mm, -30.0_mm}, Bench::in_air);
    EXPECT_EQ(bench.simulation.undo(), "");
    EXPECT_EQ(bench.simulation.bodies().size(), 2u);
    EXPECT_EQ(length(bench.place_of(0)), 0.0);
    EXPECT_EQ(bench.simulation.present().added(), 0.0);
}

TEST(Fuse, WhatIsFarApartStaysApart) {
    Bench bench;
    bench.sever(2.0_mm);
    bench.grasp_the_end();
    bench.go_to({0.0_mm, 15.0_mm, -1.6_mm}, Bench::in_air);
    EXPECT_NE(bench.simulation.fuse().find("near enough"), std::string::npos);
    EXPECT_EQ(bench.simulation.bodies().size(), 2u);
    bench.simulation.command_drive(0, 0.0);
    bench.wait(2);
    EXPECT_EQ(bench.simulation.fuse(), "nothing is held");
}

TEST(Insert, MetalStopsWhatWouldCutItAndKeepsItsShape) {
    // Given a block of metal before the bar, 2 mm thick
    Bench bench;
    const Body metal = test::block({-4.0_mm, -7.0_mm, -1.5_mm}, {-2.0_mm, 7.0_mm, 1.5_mm}, 0.2_mm);
    ASSERT_EQ(bench.simulation.insert(metal, identity_pose(), false), "");
    // When the mill goes there
    bench.go_to({-6.0_mm, 2.0_mm, 6.0_mm}, Bench::in_air);
    bench.go_to({-3.0_mm, 2.0_mm, 6.0_mm});
    bench.wait(100);
    // Then it stands at its face, and nothing is cut
    const Vec3 beside_it = bench.simulation.world_from_tool() * Vec3{0, 0, -6.0_mm};  // the tool leans on it
    EXPECT_NEAR(beside_it.x, -4.0_mm - test::Mill::radius, 0.05_mm);
    EXPECT_EQ(bench.simulation.present().removed(), 0.0);
    EXPECT_GT(length(linear(bench.last.coupled_on_hand)), 0.5);
}

TEST(Insert, TheSeventeenthBodyIsRefusedAndNothingChanges) {
    Bench bench;
    const Body small = test::block({-0.5_mm, -0.5_mm, -0.5_mm}, {0.5_mm, 0.5_mm, 0.5_mm}, 0.2_mm);
    for (int n = 1; n < static_cast<int>(max_bodies); ++n)
        ASSERT_EQ(bench.simulation.insert(small, {{20.0_mm * n, 0, 0}, {1, 0, 0, 0}}, true), "") << n;
    const std::uint64_t hash = bench.simulation.present().hash();
    EXPECT_NE(bench.simulation.insert(small, identity_pose(), true).find("16 bodies"), std::string::npos);
    EXPECT_EQ(bench.simulation.bodies().size(), max_bodies);
    EXPECT_EQ(bench.simulation.present().hash(), hash);
}

TEST(Insert, BoneOfOtherTissuesIsRefused) {
    Bench bench;
    Body other = test::block({-0.5_mm, -0.5_mm, -0.5_mm}, {0.5_mm, 0.5_mm, 0.5_mm}, 0.2_mm);
    other.materials.front().id = "enamel";
    EXPECT_NE(bench.simulation.insert(other, identity_pose(), true), "");
}

TEST(Subtract, TakesWhatTheSolidHolds) {
    Bench bench;
    bench.simulation.subtract(0, test::mill_at(0.0, 2.0_mm));
    const double cylinder = pi * test::Mill::radius * test::Mill::radius * 3.0_mm;
    EXPECT_NEAR(bench.simulation.present().removed(), cylinder, 0.02 * cylinder);
    EXPECT_TRUE(bench.simulation.committed().same_bits(bench.simulation.exact()));
    EXPECT_EQ(bench.simulation.undo(), "");
    EXPECT_EQ(bench.simulation.present().removed(), 0.0);
}

TEST(Undo, BringsTheBoneBackBitForBitAndRedoDoesItAgain) {
    Bench bench;
    const CutField uncut = bench.simulation.exact();
    bench.sever(2.0_mm);
    bench.go_to({12.0_mm, 2.0_mm, 6.0_mm}, Bench::in_air);
    const std::uint64_t once = bench.simulation.present().hash();
    bench.go_to({12.0_mm, -20.0_mm, 6.0_mm}, Bench::in_air);
    bench.go_to({-12.0_mm, -20.0_mm, 6.0_mm}, Bench::in_air);
    bench.sever(-3.0_mm);
    bench.go_to({12.0_mm, -3.0_mm, 6.0_mm}, Bench::in_air);
    const std::uint64_t twice = bench.simulation.present().hash();
    const double removed = bench.simulation.present().removed();
    ASSERT_EQ(bench.simulation.bodies().size(), 3u);

    EXPECT_EQ(bench.simulation.undo(), "");
    EXPECT_EQ(bench.simulation.bodies().size(), 2u);
    EXPECT_EQ(bench.simulation.present().hash(), once);
    EXPECT_EQ(bench.simulation.undo(), "");
    EXPECT_EQ(bench.simulation.bodies().size(), 1u);
    EXPECT_TRUE(bench.simulation.exact().same_bits(uncut));
    EXPECT_TRUE(bench.simulation.committed().same_bits(uncut));
    EXPECT_EQ(bench.simulation.present().removed(), 0.0);
    EXPECT_NE(bench.simulation.undo(), "");

    EXPECT_EQ(bench.simulation.redo(), "");
    EXPECT_EQ(bench.simulation.present().hash(), once);
    EXPECT_EQ(bench.simulation.redo(), "");
    EXPECT_EQ(bench.simulation.present().hash(), twice);
    EXPECT_EQ(bench.simulation.present().removed(), removed);
    EXPECT_NE(bench.simulation.redo(), "");
    for (std::size_t b = 0; b < 3; ++b)
        EXPECT_TRUE(bench.simulation.committed(b).same_bits(bench.simulation.exact(b))) << b;
}

TEST(Undo, AnotherCutAfterwardsIsAsIfTheFirstHadNeverBeen) {
    Bench undone, plain;
    undone.sever(2.0_mm);
    undone.go_to({12.0_mm, 2.0_mm, 6.0_mm}, Bench::in_air);
    ASSERT_EQ(undone.simulation.undo(), "");
    // Back in the air, then the same way in both
    for (Bench* bench : {&undone, &plain}) {
        for (const Vec3 to : {Vec3{bench->hand.position.x, -20.0_mm, 6.0_mm}, Vec3{-12.0_mm, -20.0_mm, 6.0_mm}})
            bench->go_to(to, Bench::in_air);
        bench->sever(-3.0_mm);
        bench->simulation.finish();
    }
    ASSERT_EQ(undone.simulation.bodies().size(), 2u);
    EXPECT_NEAR(undone.simulation.present().removed(), plain.simulation.present().removed(),
                1e-3 * plain.simulation.present().removed());
    EXPECT_NE(undone.simulation.redo(), "");
}

TEST(Undo, AirMotionAddsNoCut) {
    // Given the mill on its way past the bar, 0.3 mm from it, and its tip where none was before: its sweep is stamped
    Bench bench;
    bench.go_to({-4.0_mm, 12.0_mm, 6.0_mm}, Bench::in_air);
    std::size_t stamped = 0;
    const double beside = -1.5_mm - test::Mill::radius - 0.3_mm;
    for (const Vec3 to : {Vec3{beside, 12.0_mm, 6.1_mm}, Vec3{beside, -12.0_mm, 6.1_mm}}) {
        const int ticks = static_cast<int>(length(to - bench.hand.position) / 20.0_um);
        for (int left = ticks; left > 0; --left) {
            bench.go_to(bench.hand.position + (1.0 / left) * (to - bench.hand.position), 1.0);
            for (const CutRecord& record : bench.simulation.closed()) stamped += record.removes;
        }
    }
    ASSERT_GT(stamped, 0u);
    EXPECT_EQ(bench.simulation.present().removed(), 0.0);
    EXPECT_EQ(bench.simulation.undo(), "there is no cut to take back");
}

TEST(Undo, WaitsUntilTheToolIsClearOfTheBone) {
    Bench bench;
    bench.go_to({-4.0_mm, 2.0_mm, 6.0_mm});
    bench.go_to({0.0_mm, 2.0_mm, 6.0_mm});
    const std::uint64_t half_way = bench.simulation.present().hash();
    EXPECT_EQ(bench.simulation.undo(), "the tool is not clear of the bone");
    EXPECT_EQ(bench.simulation.present().hash(), half_way);
}

}  // namespace
}  // namespace kerf
