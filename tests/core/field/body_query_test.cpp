// SPDX-License-Identifier: Apache-2.0
#include "core/field/cut/body_query.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

#include "tests/support/block.h"
#include "tests/support/scalar_bone_query.h"

namespace kerf {
namespace {

using namespace literals;

/// A drill that is pushed straight down into a block whose face is z = 0.
struct Hole {
    double h = 0.25_mm;
    Body body = test::block({-5.0_mm, -5.0_mm, -12.0_mm}, {5.0_mm, 5.0_mm, 0}, 0.25_mm);
    ToolSolid tool = test::drill_outline(1.6_mm, 59.0_deg, 2.0_mm);
    CutField committed{body, 512};
    CutField exact{body, 512};
    CutTracker tracker{body, tool, committed};
    BodyQuery view{body, committed, tracker};
    std::uint64_t tick = 0;
    double depth = -2.0_mm;

    Hole() { tracker.restart(pose()); }
    [[nodiscard]] Pose pose() const { return test::pointing({0.07_mm, 0.03_mm, -depth}, {0, 0, -1}); }

    void move_to(double target, double step = 1.0_um) {
        while (std::abs(target - depth) > 1e-12) {
            depth += std::clamp(target - depth, -step, step);
            const int closed = tracker.advance(pose(), tick++);
            for (int i = 0; i < closed; ++i)
                if (tracker.closed(i).removes) exact.stamp(tracker.closed(i), tool);
            tracker.commit_passed(pose(), gap_of_edge() == 0.0);
            view.place(pose());
        }
    }
    /// A point in the middle of a lip.
    [[nodiscard]] kerf_bone_sample edge() const {
        const Vec3 lip{0.8_mm, 0, -0.8_mm / std::tan(59.0_deg)};
        kerf_bone_sample s;
        view.sample(&lip, 1, {0, 0, 1}, &s);
        return s;
    }
    [[nodiscard]] double gap_of_edge() const { return edge().gap; }
};

TEST(LaggedCut, AnAdvancingEdgeStaysFullyEngaged) {
    Hole hole;
    hole.move_to(3.0_mm);
    for (int i = 0; i < 500; ++i) {
        hole.move_to(hole.depth + 1.0_um);
        ASSERT_EQ(hole.edge().engagement, 1.0) << hole.depth;
        ASSERT_EQ(hole.edge().gap, 0.0) << hole.depth;
    }
}

TEST(LaggedCut, AfterWithdrawalTheGapIsTheWayBackToTheFront) {
    for (const double back : {1.0_um, 10.0_um, 0.1_mm, 0.2_mm}) {
        Hole hole;
        hole.move_to(3.0_mm);
        hole.move_to(3.0_mm - back);
        const kerf_bone_sample edge = hole.edge();
        ASSERT_EQ(edge.engagement, 1.0) << "the lag keeps the bone, the gap keeps it silent";
        EXPECT_NEAR(edge.gap, back, 0.2_um /* the record's step */) << back;
    }
}

TEST(LaggedCut, ContactNeverMeetsWhatTheOpenStretchHasTaken) {
    Hole hole;
    hole.move_to(3.0_mm);
    const Vec3 behind_the_tip{0, 0, -0.06 * hole.h / std::sin(59.0_deg)};
    std::size_t records = 0, ticks = 0;
    double deepest = 0.0;
    for (; ticks < 500; ++ticks) {
        const std::uint64_t before = hole.tracker.next_sequence();
        hole.move_to(hole.depth + 1.0_um);
        records += hole.tracker.next_sequence() - before;
        kerf_surface_point at;
        hole.view.nearest(&behind_the_tip, 1, &at);
        ASSERT_GE(at.distance, -1e-8) << hole.depth;
        // Nor is what lies ahead of the tip gone
        const Vec3 ahead{0, 0, 0.02 * hole.h};
        hole.view.nearest(&ahead, 1, &at);
        ASSERT_LT(at.distance, 0.0) << hole.depth;
        const LocatedPoint place = locate(hole.body, hole.pose() * behind_the_tip);
        deepest = std::min(deepest, hole.exact.at(place));
    }
    EXPECT_LT(deepest, -0.05 * hole.h) << "closed records alone would have left it standing";
    EXPECT_LT(records, ticks / 40) << "a record is long";
}

TEST(LaggedCut, FarBehindTheFrontThereIsNoBoneForAnEdge) {
    Hole hole;
    hole.move_to(4.0_mm);
    hole.move_to(3.0_mm);
    EXPECT_EQ(hole.edge().engagement, 0.0);
}

TEST(LaggedCut, PeckingKeepsThePendingListShort) {
    Hole hole;
    for (int peck = 1; peck <= 5; ++peck) {
        hole.move_to(0.8_mm * peck, 5.0_um);
        EXPECT_LE(hole.tracker.pending_count(), 12u);
        hole.move_to(-1.0_mm, 20.0_um);
        EXPECT_LE(hole.tracker.pending_count(), 12u);
    }
    EXPECT_EQ(hole.tracker.early_commits(), 0u);
}

TEST(LaggedCut, AfterAFlushBothFieldsAreTheSameBits) {
    Hole hole;
    hole.move_to(2.0_mm, 3.0_um);
    hole.move_to(1.2_mm, 7.0_um);
    hole.move_to(3.0_mm, 11.0_um);
    EXPECT_FALSE(hole.committed.same_bits(hole.exact)) << "the committed cut lags";
    hole.tracker.flush();
    EXPECT_TRUE(hole.committed.same_bits(hole.exact));
}

TEST(BodyQuery, NearestSeesTheHoleAsItIsNow) {
    Hole hole;
    hole.move_to(4.0_mm, 2.0_um);

    // In the tool's frame the wall is 1.6 mm away, just behind the corner, however short ago it was cut.
    const Vec3 inside{1.5_mm, 0, -1.2_mm};
    kerf_surface_point wall;
    hole.view.nearest(&inside, 1, &wall);
    EXPECT_NEAR(wall.distance, 0.1_mm, 0.02 * hole.h);
    EXPECT_LT(wall.normal.x, -0.98) << "outwards of the bone is towards the drill's axis";
}

/// A long drill that has swung about its tip within bone, and nobody has committed it.
struct Swung {
    static constexpr double length = 14.0_mm, widest = 1.5_mm, swing = 0.15;
    Body body = test::block({-8.0_mm, -8.0_mm, -18.0_mm}, {8.0_mm, 8.0_mm, 0}, 0.5_mm);
    ToolSolid tool = test::drill_outline(widest, 59.0_deg, length);
    CutField committed{body, 512};
    CutTracker tracker{body, tool, committed};
    BodyQuery view{body, committed, tracker};

    static Pose pose(double tilt) {
        Pose upright = test::pointing({0, 0, -16.0_mm}, {0, 0, -1});
        upright.rotation = quat_from_rotation_vector(tilt * normalized(Vec3{-0.3, 1.0, 0.0})) * upright.rotation;
        return upright;
    }
    Swung() {
        tracker.restart(pose(-swing));
        std::uint64_t tick = 0;
        for (double tilt = -swing; tilt <= swing + 1e-9; tilt += 0.01) tracker.advance(pose(tilt), tick++);
        view.place(pose(swing));
    }
};

TEST(BodyQuery, NearestMatchesBruteForceForTurnedPendingPoses) {
    const Swung swung;
    ASSERT_GT(swung.tracker.pending_count(), 5u);
    std::mt19937 random(9);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const double clamp = swung.body.grid().clamp();
    int risen = 0;
    for (int i = 0; i < 20000; ++i) {
        // A point of the tool at some pose of its swing, as the tool of now sees it
        const double angle = 2.0 * pi * unit(random), r = 1.1 * Swung::widest * unit(random);
        const Vec3 on_tool{r * std::cos(angle), r * std::sin(angle), -Swung::length * unit(random)};
        const Vec3 in_body = Swung::pose(Swung::swing * (2.0 * unit(random) - 1.0)) * on_tool;
        const Vec3 in_tool = inverse(Swung::pose(Swung::swing)) * in_body;
        const double exact = swung.view.present_distance(in_body);
        if (exact >= clamp) continue;
        kerf_surface_point at;
        swung.view.nearest(&in_tool, 1, &at);
        ASSERT_NEAR(at.distance, exact, 1.0_um /* single precision, and the grid's own steps */) << i;
        risen += swung.tracker.depth_in_pending(in_body) > swung.committed.at(locate(swung.body, in_body));
    }
    EXPECT_GT(risen, 1000) << "pending poses were seen";
}

TEST(BodyQuery, SpreadBoundsTheMotionOfEachPoint) {
    const Swung swung;
    const CutTracker::Spread& spread = swung.tracker.spread();
    const Frame newest = swung.tracker.solid_from_tool(swung.tracker.solid_count() - 1, Swung::pose(0.0));
    double tightest = 1e300;
    for (std::size_t i = 0; i + 1 < swung.tracker.solid_count(); ++i)
        for (const Vec3 p : {Vec3{0, 0, -14.0_mm}, {3.0_mm, 0, -7.0_mm}, {0, 3.0_mm, -7.0_mm}, {}}) {
            // From where a point of the newest solid is to where it is in another
            const Frame other = swung.tracker.solid_from_tool(i, Swung::pose(0.0));
            const Vec3 moved = other * p - newest * p;
            const double way = length(moved), origin = std::max(length(spread.low), length(spread.high));
            EXPECT_LE(way, origin + spread.turn * length(newest * p) + 1e-9);
            if (i == 0 && p.z == -14.0_mm) tightest = origin + spread.turn * length(newest * p) - way;
        }
    EXPECT_LT(tightest, 0.1_mm) << "and by no more than needs be: the oldest has turned farthest";
}

/// Angle between two unit vectors [rad], small.
double angle_between(Vec3 a, Vec3 b) { return length(a - b); }

TEST(BodyQuery, ANormalIsOffByLessThanTheWallTurnsInHalfAVoxel) {
    // Given a hole, and points on either side of its wall where it has been committed
    Hole hole;
    hole.move_to(6.0_mm, 2.0_um);
    const test::ScalarBoneQuery scalar{hole.body, hole.committed, hole.tracker, hole.pose()};
    constexpr int levels = 29, around = 72;

    // When the bone is asked for normals
    double worst = 0.0, squares = 0.0, worst_by_differences = 0.0;
    for (int level = 0; level < levels; ++level)
        for (int n = 0; n < around; ++n) {
            const double angle = 2.0 * pi * n / around,
                         z = -2.35_mm -
                             0.11_mm * level;  // what waits to be committed ends 1.2 voxels behind the drill's 2 mm
            const double r = 1.6_mm + (n % 5 - 2) * 0.02_mm;
            const Vec3 p{r * std::cos(angle), r * std::sin(angle), z}, inwards{-std::cos(angle), -std::sin(angle), 0.0};
            kerf_surface_point wall;
            hole.view.nearest(&p, 1, &wall);
            const double error = angle_between(wall.normal, inwards);
            worst = std::max(worst, error);
            squares += error * error;
            worst_by_differences =
                std::max(worst_by_differences, angle_between(scalar.normal_by_differences(p), inwards));
        }

    // Then they are off by what a gradient within one cell can be, about three times as much as central differences
    EXPECT_LT(worst, 0.5 * hole.h / 1.6_mm);
    EXPECT_LT(std::sqrt(squares / (levels * around)), 2.5_deg);
    EXPECT_LT(worst, 4.0 * worst_by_differences);
}

TEST(BodyQuery, OutsideTheGridAndAtNotANumberThereIsAir) {
    Hole hole;
    const double nan = std::nan("");
    const Vec3 far[] = {{1.0, 0, 0}, {0, -1e300, 0}, {nan, 0, 0}, {0, 0, nan}};
    for (const Vec3 p : far) {
        kerf_bone_sample s;
        hole.view.sample(&p, 1, {0, 0, 1}, &s);
        EXPECT_EQ(s.engagement, 0.0);
        kerf_surface_point n;
        hole.view.nearest(&p, 1, &n);
        EXPECT_EQ(n.body, -1);
    }
}

}  // namespace
}  // namespace kerf
