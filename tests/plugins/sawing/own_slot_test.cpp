// SPDX-License-Identifier: Apache-2.0
// In the slot it has cut a saw is held by nothing until it is moved farther than its teeth stand out; then it binds.
#include "plugins/sawing/own_slot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "plugins/sawing/saw_force.h"
#include "tests/support/rig.h"
#include "tests/support/saw_rig.h"
#include "tests/support/tremor.h"

namespace kerf {
namespace {

using namespace literals;
using sawing::OwnSlot;

TEST(OwnSlot, StaysWhereItIsWhileTheBladeMoves) {
    OwnSlot slot;
    slot.move(make_vec6({0, 2.0_mm_per_s, 0}, {}), 0.05, 0.0, 1.0_mm);
    EXPECT_NEAR(slot.middle(0, 0), -0.1_mm, 1e-15) << "the blade went aside, the slot is behind it";
    slot.move(make_vec6({0, -2.0_mm_per_s, 0}, {}), 0.05, 0.0, 1.0_mm);
    EXPECT_NEAR(slot.middle(5.0_mm, -5.0_mm), 0.0, 1e-15);
}
TEST(OwnSlot, TiltsAgainstTheBlade) {
    OwnSlot slot;
    slot.move(make_vec6({}, {0.01, 0, 0}), 1.0, 0.0,
              1.0_mm);  // about x: what is behind the tip goes towards +y of the blade
    EXPECT_NEAR(slot.middle(0, -10.0_mm), -0.1_mm, 1e-9);
    slot = {};
    slot.move(make_vec6({}, {0, 0, 0.01}), 1.0, 0.0, 1.0_mm);  // about z
    EXPECT_NEAR(slot.middle(10.0_mm, 0), -0.1_mm, 1e-9);
}
TEST(OwnSlot, IsWhereTheBladeIsOnceItHasCutOn) {
    OwnSlot slot;
    slot.move(make_vec6({0, 2.0_mm_per_s, 0}, {}), 0.05, 0.0, 1.0_mm);
    slot.move(make_vec6({0, 0, 1.0_mm_per_s}, {}), 1.0, 1.0_mm, 1.0_mm);
    EXPECT_EQ(slot.middle(0, 0), 0.0);
    EXPECT_NEAR(slot.depth, 1.0_mm, 1e-15);
}

/// Cut to 10 mm, then drawn back from the front by a millimetre.
struct InItsSlot {
    double h;
    test::Rig simulation{test::block({-18.0_mm, -4.0_mm, -14.0_mm}, {18.0_mm, 4.0_mm, 0}, h, {0.31, 0.17, 0.73}),
                         test::saw(), test::at_depth(-1.0_mm)};
    Pose still;

    explicit InItsSlot(double spacing) : h(spacing) {
        for (double depth = -1.0_mm; depth < 10.0_mm; depth += 4.0_um) tick(test::at_depth(depth));
        for (double depth = 10.0_mm; depth > 9.0_mm; depth -= 10.0_um) tick(test::at_depth(depth));
        still = simulation.world_from_tool();
    }
    TickResult tick(const Pose& pose) {
        const TickResult r = simulation.tick_direct({pose});
        return r;
    }
    /// Back to the front, and a little farther: from there on it knows its slot by what it has cut itself.
    void cut_on() {
        for (double depth = 9.0_mm; depth < 13.0_mm; depth += 4.0_um) tick(test::at_depth(depth));
        still = simulation.world_from_tool();
    }
    void switch_off() {
        simulation.command_drive(0, 0.0);
        for (int i = 0; i < 50; ++i) (void)tick(still);
    }
    /// The largest force across the blade in 10 s of a hand that shakes with up to 1 mm/s each way.
    double largest_side_force_while_shaken() {
        double most = 0.0;
        for (int i = 0; i < 10000; ++i) {
            const double t = i * Simulation::dt;
            const auto shake = [t](double phase) { return test::tremor(t, phase); };
            // About the grip, 140 mm behind the tip, the same speed at the tip.
            const Pose moved =
                still * Pose{{0.3 * shake(1.0), 0.5 * shake(2.0), 0.3 * shake(3.0)},
                             quat_from_rotation_vector({0.5 / 140e-3 * shake(4.0), 0.0, 0.5 / 140e-3 * shake(5.0)})};
            const Vec6 wrench = tick(moved).bone_on_tool;
            most = std::max(most, std::abs(wrench[1]));
        }
        return most;
    }
};

// What holds a blade across, at the front, does not hang on how far the committed cut lags.
TEST(BladeInItsSlot, AtTheFrontItIsHeldAlikeOnEveryGridAndInEveryTick) {
    const auto held_across = [](double h) {
        test::Rig simulation(test::block({-18.0_mm, -4.0_mm, -8.0_mm}, {18.0_mm, 4.0_mm, 0}, h, {0.31, 0.17, 0.73}),
                             test::saw(), test::at_depth(-0.5_mm));
        double least = 1e300, most = 0.0;  // [N] of the edges, of both sides
        for (double depth = -0.5_mm; depth < 5.0_mm; depth += 4.0_um) {
            (void)simulation.tick_direct({test::at_depth(depth)});
            if (depth < 4.0_mm) continue;
            double held = 0.0;
            for (const kerf_channel& c : test::law_now(simulation))
                if (c.kind == KERF_CUT && c.d[2] == 0.0 && c.d[1] != 0.0) held += c.tau;
            least = std::min(least, held);
            most = std::max(most, held);
        }
        EXPECT_GT(least, 0.99 * most) << "[N] at " << h;
        return most;
    };
    const double coarse = held_across(0.5_mm), fine = held_across(0.125_mm);
    EXPECT_GT(fine, 10.0);
    EXPECT_NEAR(coarse / fine, 1.0, 0.02);
}

// B5
TEST(BladeInItsSlot, HandNoiseIsNotFeltAcrossTheBlade) {
    for (const double h : {0.5_mm, 0.2_mm})
        for (const bool is_on : {true, false}) {
            InItsSlot saw(h);
            if (!is_on) saw.switch_off();
            const double most = saw.largest_side_force_while_shaken();
            RecordProperty("side_force_mN_at_" + std::to_string(static_cast<int>(h * 1e6)) + (is_on ? "_on" : "_off"),
                           std::to_string(1e3 * most));
            EXPECT_LT(most, 0.05) << "N, at " << h << (is_on ? ", going" : ", still");
        }
}

TEST(BladeInItsSlot, PushedAsideItIsHeldByThatSideAlone) {
    for (const double way : {1.0, -1.0}) {
        InItsSlot saw(0.25_mm);
        saw.cut_on();
        for (double aside = 0.0; aside < 0.2_mm; aside += 2.0_um) {
            Pose at = saw.still;
            at.position.y += way * aside;
            saw.tick(at);
        }
        const double side = rotate(conjugate(saw.still.rotation), {0, way, 0}).y;  // of the blade, towards its way
        double towards = 0.0, back = 0.0;  // [m] the deepest contact on either side
        for (const kerf_channel& c : test::law_now(saw.simulation)) {
            if (c.kind != KERF_CONTACT || c.d[1] == 0.0) continue;
            double& deepest = c.d[1] * side > 0.0 ? towards : back;
            deepest = std::max(deepest, c.delta);
        }
        EXPECT_GT(towards, 0.0) << way;
        EXPECT_EQ(back, 0.0) << way;
    }
}

TEST(BladeInItsSlot, BindsBeyondToothSet) {
    InItsSlot saw(0.25_mm);
    saw.switch_off();
    double free = 0.0, bound = 0.0;
    for (double aside = 0.0; aside < 0.3_mm; aside += 2.0_um) {
        Pose at = saw.still;
        at.position.y += aside;
        const double side = -saw.tick(at).bone_on_tool[1];
        if (aside < 0.07_mm) free = std::max(free, std::abs(side));
        bound = side;
    }
    EXPECT_LT(free, 0.05);
    EXPECT_GT(bound, 0.2) << "N: a blade of 0.8 mm bends; 0.2 mm at some 3 N/mm";
    EXPECT_GT(signals_of<sawing::SawCutting>(saw.simulation.signals()).binding, 0.2);
}

/// The wall of the blade's own slot as its contact near the front sees it: how deep each side stands in it [m], tool
/// frame. No channel is negative: free.
struct Sides {
    double plus_y = 0.0, minus_y = 0.0;
};
Sides near_front(const Simulation& simulation) {
    Sides sides{-1.0, -1.0};
    for (const kerf_channel& c : test::law_now(simulation)) {
        const bool is_near = std::abs(c.d[3]) < 10.0_mm;  // the lever about the tip, along the blade
        if (c.kind != KERF_CONTACT || std::abs(c.d[1]) < 0.5 || !is_near) continue;
        double& side = c.d[1] > 0.0 ? sides.plus_y : sides.minus_y;
        side = std::max(side, c.delta);
    }
    return sides;
}

TEST(BladeInItsSlot, OnlyTheSidePushedToPushesBack) {
    for (const double way : {1.0, -1.0}) {
        InItsSlot saw(0.25_mm);
        saw.cut_on();
        saw.switch_off();
        for (double aside = 0.0; aside < 0.3_mm; aside += 2.0_um)
            (void)saw.tick(saw.still * Pose{{0, way * aside, 0}, {1, 0, 0, 0}});
        const Sides sides = near_front(saw.simulation);
        const double pushed_into = way > 0.0 ? sides.plus_y : sides.minus_y;
        const double max_cutting_gap = way > 0.0 ? sides.minus_y : sides.plus_y;
        EXPECT_NEAR(pushed_into, 0.3_mm - 0.1_mm /* its teeth stand out */, 0.02_mm) << "towards " << way << " y";
        EXPECT_LT(max_cutting_gap, 0.0) << "towards " << way << " y";
    }
}

TEST(BladeInItsSlot, EachEndMeetsItsWallWhenTwisted) {
    InItsSlot saw(0.25_mm);
    saw.switch_off();
    TickResult last;
    for (double angle = 0.0; angle < 3.0_deg; angle += 0.01_deg)
        last = saw.tick(saw.still * Pose{{0, 0, 0}, quat_from_rotation_vector({0, 0, angle})});
    // Turned about +z, the blade's +x end goes to +y and meets the wall there; its −x end to −y
    double plus_x = 0.0, minus_x = 0.0;
    for (const kerf_channel& c : test::law_now(saw.simulation)) {
        if (c.kind != KERF_CONTACT || std::abs(c.d[1]) < 0.5 || !(c.delta > 0.0)) continue;
        (c.d[5] * c.d[1] > 0.0 ? plus_x : minus_x) += c.d[1] > 0.0 ? 1.0 : -1.0;  // d[5] = x d_y
    }
    EXPECT_GT(plus_x, 0.0);
    EXPECT_LT(minus_x, 0.0);
}

TEST(BladeInItsSlot, IsTwistedBackWhenItIsTwisted) {
    InItsSlot saw(0.25_mm);
    saw.switch_off();
    TickResult last;
    for (double angle = 0.0; angle < 3.0_deg; angle += 0.01_deg)
        last = saw.tick(saw.still * Pose{{0, 0, 0}, quat_from_rotation_vector({0, 0, angle})});
    // The shaft points along −z of the world: a turn about it comes back as a torque about it.
    EXPECT_LT(-last.bone_on_tool[5], -1.0_Nmm);
    double work = 0.0;
    for (double angle = 3.0_deg; angle > 0.0; angle -= 0.01_deg) {
        last = saw.tick(saw.still * Pose{{0, 0, 0}, quat_from_rotation_vector({0, 0, angle})});
        work += last.bone_on_tool[5];
    }
    EXPECT_LT(std::abs(last.bone_on_tool[5]), 0.05_Nmm) << "and is let go";
}

}  // namespace
}  // namespace kerf
