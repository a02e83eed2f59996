// SPDX-License-Identifier: Apache-2.0
#include "run/device/mouse_hand.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace kerf::run {
namespace {

constexpr double dt = 1e-3;
constexpr double mm = 1e-3;
constexpr double degree = std::numbers::pi / 180.0;

/// 600 N/m, so 10 N stretch the arm by 16.7 mm. The lean grows by 3.4 mm a second for each millimetre of lead.
Arm arm() { return {.plant = {.arm_stiffness = 600.0, .leaning = 2040.0, .resolution = 0.0}, .max_push = 10.0}; }

/// A hand at the origin, whose tool follows it, and a mouse that is seen 60 times a second.
struct Rig {
    MouseHand hand{arm(), identity_pose(), {}, dt};
    MouseTotals totals;  ///< of the mouse
    TouchedTool touched;
    int ticks = 0;

    [[nodiscard]] Vec3 at() const { return hand.reported().position; }
    void tick() {
        if (ticks * 60 / 1000 != (ticks + 1) * 60 / 1000) hand.take(totals);
        ++ticks;
        touched.world_from_tool.position = at() - touched.lie;
        hand.step(touched);
    }
    void rest(double seconds) {
        for (int i = 0; i < std::lround(seconds / dt); ++i) tick();
    }
    /// Moves the mouse at these speeds [m/s], [m/s], [rad/s], [rad/s].
    void move(Vec3 moved, double along, double seconds, Vec3 tilted = {}, double turned = 0.0) {
        for (int i = 0; i < std::lround(seconds / dt); ++i) {
            totals.moved = totals.moved + dt * moved;
            totals.along += dt * along;
            totals.tilted = totals.tilted + dt * tilted;
            totals.turned += dt * turned;
            tick();
        }
    }
    /// Lets bone push back with this force [N].
    void resist(Vec3 force) {
        touched.command.wrench = make_vec6(force, {});
        touched.resistance = std::max(1.0, length(force));
    }
    /// Pushes along z against a wall of 5 N/mm at `z`. Returns the largest force on it [N].
    double push_wall(double z, double speed, double seconds) {
        double max_force = 0.0;
        for (int i = 0; i < std::lround(seconds / dt); ++i) {
            const double force = 5e3 * std::max(0.0, at().z - z);
            touched.command.wrench = make_vec6({0, 0, -force}, {});
            touched.resistance = force;
            max_force = std::max(max_force, force);
            move({}, speed, dt);
        }
        return max_force;
    }
};

TEST(MouseHand, RestsWhileTheMouseIsStill) {
    Rig rig;
    rig.totals.moved = {};
    rig.rest(5.0);
    EXPECT_EQ(length(rig.at()), 0.0);
    EXPECT_EQ(rig.hand.reported().rotation.w, 1.0);
}

TEST(MouseHand, MovesByWhatTheMouseMoved) {
    Rig rig;
    rig.move({3.0 * mm, 0, 0}, 4.0 * mm, 2.0);
    rig.rest(1.0);
    EXPECT_NEAR(rig.at().x, 6.0 * mm, 0.01 * mm);
    EXPECT_NEAR(rig.at().z, 8.0 * mm, 0.01 * mm) << "the tool's axis is z";
    EXPECT_NEAR(rig.at().y, 0.0, 1e-9);
}

TEST(MouseHand, StartsFromTheTotalsAtItsStart) {
    MouseTotals before;
    before.moved = {0.5, 0, 0};
    before.turned = 7.0;
    MouseHand hand(arm(), identity_pose(), before, dt);
    for (int i = 0; i < 1000; ++i) {
        hand.take(before);
        hand.step({.world_from_tool = hand.reported()});
    }
    EXPECT_EQ(length(hand.reported().position), 0.0);
    EXPECT_EQ(hand.reported().rotation.w, 1.0);
}

TEST(MouseHand, MovesAt30MillimetresPerSecondInAir) {
    Rig rig;
    rig.move({100.0 * mm, 0, 0}, 0.0, 1.0);
    const double before = rig.at().x;
    rig.move({100.0 * mm, 0, 0}, 0.0, 1.0);
    EXPECT_NEAR(rig.at().x - before, 30.0 * mm, 0.15 * mm);
}

TEST(MouseHand, ForgetsAFlickAfterAQuarterOfASecond) {
    Rig rig;
    rig.totals.moved = {50.0 * mm, 0, 0};
    rig.rest(2.0);
    EXPECT_NEAR(rig.at().x, 7.5 * mm, 0.03 * mm) << "0.25 s at 30 mm/s";
}

TEST(MouseHand, LosesNothingWithASample) {
    Rig with, without;
    for (Rig* rig : {&with, &without})
        for (int i = 0; i < 1000; ++i) {
            rig->totals.moved.x += 5e-6;
            if (i % 10 == 0 && (rig == &with || i % 30 == 0)) rig->hand.take(rig->totals);
            rig->touched.world_from_tool.position = rig->at();
            rig->hand.step(rig->touched);
        }
    with.rest(1.0);
    without.rest(1.0);
    EXPECT_NEAR(with.at().x, 5.0 * mm, 0.01 * mm);
    EXPECT_NEAR(without.at().x, 5.0 * mm, 0.01 * mm);
}

TEST(MouseHand, MovesAt1AndAHalfTimesThePlannedFeedInBone) {
    Rig rig;
    rig.hand.begin_step(2.0 * mm, 0.0);
    rig.resist({0, 0, -0.1});
    rig.move({}, 50.0 * mm, 1.0);
    double before = rig.at().z;
    rig.move({}, 50.0 * mm, 2.0);
    EXPECT_NEAR(rig.at().z - before, 6.0 * mm, 0.1 * mm);
    rig.resist({0, 0, 0.1});
    rig.move({}, -50.0 * mm, 0.3);
    before = rig.at().z;
    rig.move({}, -50.0 * mm, 0.2);
    EXPECT_NEAR(rig.at().z - before, -6.0 * mm, 0.3 * mm) << "back out as in air";
}

TEST(MouseHand, PushesAWallWithItsMaximum) {
    Rig rig;
    static_cast<void>(rig.push_wall(1.0 * mm, 20.0 * mm, 8.0));
    EXPECT_NEAR(rig.push_wall(1.0 * mm, 20.0 * mm, 2.0), 10.0, 0.2);
    EXPECT_LE(length(rig.hand.stretch()), 10.0 / 600.0 * (1.0 + 1e-9)) << "no further ahead than it can push";
}

TEST(MouseHand, LeansLongerThanItLeads) {
    // A lead of 3 mm pushes with 1.8 N; the lean grows by 10.2 mm a second.
    Rig rig;
    EXPECT_LT(rig.push_wall(0.0, 20.0 * mm, 0.5), 2.5);
    EXPECT_GT(rig.push_wall(0.0, 20.0 * mm, 3.5), 9.8);
}

// A pull that fades does not keep a push from growing.
TEST(MouseHand, LeansAfterAPull) {
    Rig rig;
    rig.resist({0, 0, 3.0});
    rig.move({}, -20.0 * mm, 2.0);
    rig.resist({});
    rig.rest(0.1);
    EXPECT_GT(rig.push_wall(rig.at().z, 20.0 * mm, 3.5), 9.8) << "as without the pull";
}

TEST(MouseHand, EndsThePushWhenTheMouseRests) {
    Rig rig;
    ASSERT_GT(rig.push_wall(0.0, 20.0 * mm, 5.0), 9.0);
    EXPECT_GT(rig.push_wall(0.0, 0.0, 0.2), 9.0) << "a pause between two notches of a wheel";
    static_cast<void>(rig.push_wall(0.0, 0.0, 0.75));
    EXPECT_LT(rig.push_wall(0.0, 0.0, 0.001), 1.0);
    static_cast<void>(rig.push_wall(0.0, 0.0, 1.0));
    const double z = rig.at().z;
    static_cast<void>(rig.push_wall(0.0, 0.0, 1.0));
    EXPECT_NEAR(rig.at().z, z, 0.01 * mm);
}

TEST(MouseHand, ForgetsAPushAcrossItsHole) {
    Rig rig;
    rig.hand.begin_step(10.0 * mm, 0.0);
    rig.touched.resistance = 5.0;
    const auto feed_along_wall = [&](double speed, double seconds) {  // the wall is at x = 0
        for (int i = 0; i < std::lround(seconds / dt); ++i) {
            rig.touched.command.wrench = make_vec6({-1e5 * std::max(0.0, rig.at().x), 0, 0}, {});
            rig.move({speed, 0, 0}, 1.0 * mm, dt);
        }
    };
    feed_along_wall(5.0 * mm, 3.0);
    EXPECT_NEAR(rig.hand.stretch().x, 3.0 * mm, 0.05 * mm) << "the lead, without leaning";
    feed_along_wall(0.0, 0.5);
    const double before = rig.hand.stretch().x;
    feed_along_wall(0.0, 2.0);
    EXPECT_NEAR(rig.hand.stretch().x, before * std::exp(-1.0), 0.1 * mm);
}

// ---- turns ---------------------------------------------------------------------------------------------------------

TEST(MouseHand, TiltsBy30DegreesPerSecondInAir) {
    Rig rig;
    rig.move({}, 0.0, 1.0, {2.0, 0, 0});
    EXPECT_NEAR(small_rotation_vector(rig.hand.reported().rotation).x, 30.0 * degree, 1.0 * degree);
    EXPECT_EQ(length(rig.at()), 0.0) << "about the tip";
    rig.rest(1.0);
    EXPECT_NEAR(small_rotation_vector(rig.hand.reported().rotation).x, 37.5 * degree, 0.6 * degree)
        << "a quarter of a second is remembered";
}

TEST(MouseHand, TiltsNoDeeperThanAMillimetre) {
    const auto tilt_at = [](double depth) {
        Rig rig;
        rig.touched.resistance = 5.0;
        rig.tick();  // it meets bone
        rig.hand.begin_step(100.0 * mm, 0.0);
        rig.move({}, depth / 0.5, 0.5);
        rig.rest(0.2);
        EXPECT_NEAR(rig.at().z, depth, 0.2 * mm);
        rig.move({}, 0.0, 0.5, {0.1, 0, 0});
        rig.rest(0.2);
        return small_rotation_vector(rig.hand.reported().rotation).x;
    };
    EXPECT_NEAR(tilt_at(0.5 * mm), 0.05, 0.002);
    EXPECT_EQ(tilt_at(2.0 * mm), 0.0);
}

TEST(MouseHand, TurnsAScrewByHalfATurnPerSecondAndRegrips) {
    Rig rig;
    rig.touched.has_thread = true;
    rig.hand.begin_step(1.0 * mm, std::numbers::pi);
    double turned = 0.0, before = 0.0;
    int regrips = 0;
    bool was_regripping = false;
    // Half a turn takes 1 s, and turning back 1.57 s.
    for (int i = 0; i < 6140; ++i) {
        rig.move({}, 0.0, dt, {}, 10.0);
        const double now = 2.0 * std::atan2(rig.hand.reported().rotation.z, rig.hand.reported().rotation.w);
        const double step = std::remainder(now - before, 2.0 * std::numbers::pi);
        EXPECT_LE(std::abs(step), std::numbers::pi * dt + 1e-9);
        if (!rig.hand.is_regripping() && !was_regripping) turned += step;
        before = now;
        regrips += rig.hand.is_regripping() && !was_regripping ? 1 : 0;
        was_regripping = rig.hand.is_regripping();
    }
    EXPECT_EQ(regrips, 2);
    EXPECT_NEAR(turned, 3.0 * std::numbers::pi, 0.15) << "three half turns in 3 s, and two regrips";
}

TEST(MouseHand, TurnsADrillOnlyOutsideOfItsHole) {
    Rig rig;
    rig.move({}, 0.0, 0.5, {}, 1.0);
    EXPECT_NEAR(small_rotation_vector(rig.hand.reported().rotation).z, 0.5, 0.05);
    rig.rest(0.5);
    rig.touched.resistance = 5.0;
    rig.hand.begin_step(100.0 * mm, 0.0);
    rig.move({}, 5.0 * mm, 0.5);
    const double before = small_rotation_vector(rig.hand.reported().rotation).z;
    rig.move({}, 0.0, 0.5, {}, 1.0);
    EXPECT_EQ(small_rotation_vector(rig.hand.reported().rotation).z, before);
}

// ---- faults --------------------------------------------------------------------------------------------------------

TEST(MouseHand, RestsWhileTheForceIsAway) {
    Rig rig;
    rig.move({10.0 * mm, 0, 0}, 0.0, 0.5);
    const Vec3 before = rig.at();
    rig.touched.is_force_away = true;
    rig.move({10.0 * mm, 0, 0}, 10.0 * mm, 0.5, {1, 0, 0}, 1.0);
    EXPECT_EQ(length(rig.at() - before), 0.0);
    rig.touched.is_force_away = false;
    rig.rest(1.0);
    EXPECT_EQ(length(rig.at() - before), 0.0) << "what the mouse did meanwhile is dropped";
}

TEST(MouseHand, LetsATakenToolRest) {
    // A driver leaves its screw 40 mm deep: the next tool lies 40 mm behind the handle, and moves in the hand towards
    // it.
    Rig rig;
    rig.hand.take_tool();
    rig.touched.is_realigning = true;
    for (int i = 0; i < 3000; ++i) {
        rig.touched.lie = {0, 0, 40.0 * mm * std::exp(-i * dt / 0.3)};
        rig.tick();
        EXPECT_NEAR(rig.at().z - rig.touched.lie.z, -40.0 * mm, 1e-9) << "the tool";
    }
    rig.move({}, 5.0 * mm, 1.0);
    rig.rest(0.5);
    EXPECT_NEAR(rig.at().z, -35.0 * mm, 0.02 * mm);
}

TEST(MouseHand, MovesATakenToolAsInAir) {
    Rig rig;
    rig.hand.begin_step(1.0 * mm, 0.0);
    rig.touched.resistance = 5.0;
    rig.rest(1.0);
    rig.touched.resistance = 0.0;
    rig.hand.take_tool();
    rig.move({}, 20.0 * mm, 0.15);
    rig.rest(0.5);
    EXPECT_NEAR(rig.at().z, 3.0 * mm, 0.1 * mm) << "in bone it would go 1.5 mm a second";
}

TEST(MouseHand, IgnoresTotalsThatAreNoNumbers) {
    Rig rig;
    MouseTotals bad;
    bad.moved.y = std::numeric_limits<double>::quiet_NaN();
    rig.hand.take(bad);
    bad = {};
    bad.turned = std::numeric_limits<double>::infinity();
    rig.hand.take(bad);
    rig.rest(0.5);
    EXPECT_EQ(length(rig.at()), 0.0);
}

}  // namespace
}  // namespace kerf::run
