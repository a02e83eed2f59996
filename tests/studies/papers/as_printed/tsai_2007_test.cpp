// SPDX-License-Identifier: Apache-2.0
#include "studies/papers/as_printed/tsai_2007.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/studies/papers/as_printed/printed_rig.h"

namespace kerf::as_printed {
namespace {

using namespace literals;

constexpr double half_web = 0.405_mm;  // of a 5.4 mm drill
const SinCos half_point = sin_cos_exact(59.0_deg);

double share_that_is_lost(double r) {
    const ThrustAndRadius to = lip_transform(r, half_web, half_point, 0.0, 1.0);
    return 1.0 - std::hypot(to.thrust, to.radius);
}

// P1: a transform keeps the length of a force. This one does not.
TEST(Tsai2007, LipTransformLosesForceEverywhereAndMostNextToTheWeb) {  // E00-1
    EXPECT_NEAR(share_that_is_lost(2.7_mm), 0.008, 0.001);
    EXPECT_NEAR(share_that_is_lost(1.5_mm), 0.027, 0.001);
    EXPECT_NEAR(share_that_is_lost(0.8_mm), 0.099, 0.001);
    EXPECT_NEAR(share_that_is_lost(half_web), 0.48, 0.01);
}

TEST(Tsai2007, TheSlipTakesATwentiethOfTheLipsThrust) {  // E00-1, of a 5.4 mm drill
    const double tool[] = {5.4_mm, 118.0_deg, 0.15, 100.0_mm};
    const LipPoints lips = lip_points(value_of<PaperBit>(tool).drill(), 0.01_mm, 0.0);
    double printed = 0.0, right = 0.0;
    for (std::size_t i = 0; i < lips.count; ++i) {
        const double thrust = lip_transform(lips.point[i].r, half_web, half_point, 0.0, 1.0).thrust;
        printed += thrust;
        right += thrust / (1.0 - share_that_is_lost(lips.point[i].r));
    }
    EXPECT_NEAR(1.0 - printed / right, 0.0516, 0.001);
}

// P3: antipodal elements in one material cancel. These do not.
TEST(Tsai2007, EqualLipsPushSidewaysWithMoreThanTheThrust) {  // E00-2
    test::InTheBlock block("000");
    const Vec3 force = linear(block.go(block.depth() + 8.0_um).wrench);
    EXPECT_GT(std::hypot(force.x, force.y), std::abs(force.z)) << "where there is no sideways force at all";
}

/// The law of a 5.4 mm drill at 8 mm/s and 1000 rpm, both lips in whole cortical bone.
struct InWholeBone {
    kerf_bone_query query{};
    Held<PaperBit> tool{value_of<PaperBit>(std::array<double, 4>{5.4_mm, 118.0_deg, 0.15, 100.0_mm}), {.dt = 1e-3}};
    Tsai2007 law = defaults_of<Tsai2007>();
    Tsai2007::State state;

    InWholeBone() {
        query.tissue_count = 1;
        query.sample = [](const kerf_bone*, const kerf_vec3*, std::uint32_t count, const kerf_vec3*, std::uint32_t,
                          kerf_bone_sample* out) {
            for (std::uint32_t i = 0; i < count; ++i) out[i] = {1.0, 0.0, {1.0}, {1850.0}, 0, 0};
        };
        state.rate[2] = 8.0_mm_per_s;
    }
    [[nodiscard]] double t_thrust() const {
        State after = state;
        Tsai2007::Signals signals;
        kerf_action action[KERF_MAX_ACTIONS];
        kerf_commit_out out{};
        out.action = action;
        Actions actions(out);
        law.commit(tool, BoneQuery(query), {}, after, signals, actions);
        return signals.t_thrust;
    }
    [[nodiscard]] kerf_law evaluate() {
        kerf_law out{sizeof(kerf_law), 0, channel, {}, {}};
        Channels channels(out);
        law.resist(tool, BoneQuery(query), state, channels);
        return out;
    }

private:
    using State = Tsai2007::State;
    kerf_channel channel[KERF_MAX_CHANNELS] = {};
};

TEST(Tsai2007, TThrustIsATorqueWhereTheMomentIsNone) {  // E00-3: r × F of equal lips cancels
    EXPECT_GT(InWholeBone().t_thrust(), 100.0_Nmm);
}

// 00-18: the paper's device has no torques, so its T_thrust is rendered along the axis. By which length is not said,
// and that decides what it costs.
TEST(Tsai2007, TThrustAddedToTheThrustIsAHundredthOfItOrAThird) {
    InWholeBone bone;
    bone.tool.diameter = 3.2_mm;
    bone.state.rate[2] = 2.0_mm_per_s;  // the measured point that the coefficients come from
    const auto thrust = [&](double arm) {
        bone.law.torque_arm = arm;
        return -bone.evaluate().wrench[2];
    };
    const double without = thrust(0.0);
    EXPECT_NEAR(without, 198.4, 0.1);
    EXPECT_NEAR(bone.t_thrust(), 103.0_Nmm, 1.0_Nmm);
    EXPECT_NEAR(thrust(100.0_mm) - without, 1.03, 0.01) << "N, over the way to the haptic point";
    EXPECT_NEAR(thrust(1.6_mm) - without, 64.5, 0.5) << "N, over the drill's radius";
}

TEST(Tsai2007, UnlessAskedForNoTorqueIsRendered) {
    InWholeBone bone;
    EXPECT_EQ(bone.law.torque_arm, 0.0);
    const kerf_law law = bone.evaluate();
    for (const int torque : {3, 4, 5}) EXPECT_EQ(law.wrench[torque], 0.0) << torque;
}

TEST(Tsai2007, NoProcedureFindsIt) {
    const auto is_there = [](const PluginRegistry& registry) {
        for (const auto& info : registry.catalog())
            if (info.plugin == "papers.as_printed") return true;
        return false;
    };
    EXPECT_TRUE(is_there(test::printed_plugins()));
    EXPECT_FALSE(is_there(test::own_plugins())) << "lib/kerf is where procedures look";
}

TEST(Tsai2007, TheSidewaysForceTurnsWithTheDrill) {
    const Lateral at_rest = lateral_force(3.0, 4.0, sin_cos_exact(0.0)),
                  turned = lateral_force(3.0, 4.0, sin_cos_exact(90.0_deg));
    EXPECT_EQ(at_rest.x, 3.0);
    EXPECT_EQ(at_rest.y, 4.0);
    EXPECT_NEAR(turned.x, -4.0, 1e-15);
    EXPECT_NEAR(turned.y, 3.0, 1e-15);
}

TEST(Tsai2007, TiltLowersTheFeedOnBothSides) {  // E00-4
    const double straight = feed_per_revolution(2.0_mm_per_s, 2.0_mm, 0.0, 1000.0_rpm);
    const double tilting = feed_per_revolution(2.0_mm_per_s, 2.0_mm, 0.5, 1000.0_rpm);
    EXPECT_NEAR(straight, 0.12_mm, 1e-12);
    EXPECT_NEAR(tilting, 0.06_mm, 1e-12) << "an element on the other side has the same r: its feed should have risen";
}

TEST(Tsai2007, AStandingDrillHasNoFiniteForce) {  // E00-5, S-19
    EXPECT_FALSE(std::isfinite(feed_per_revolution(2.0_mm_per_s, 1.0_mm, 0.0, 0.0)));
    test::InTheBlock block("000");
    block.run->command_spindle(0.0);
    EXPECT_FALSE(std::isfinite(block.go(block.depth() + 8.0_um).wrench[2]));
}

TEST(Tsai2007, MeetsTheMeanItsCoefficientsComeFrom) {
    chart::Scene femur = chart::block_scene(chart::slab_scene(0.0), 3.0_mm);
    femur.drill.diameter = 3.2_mm;
    femur.feed = 2.0_mm_per_s;
    femur.depth = {-0.2_mm};
    chart::go_to(femur, 2.0_mm, femur.feed);
    const auto run = test::method("000").start(femur, {0.5_mm, 31, {}}, 1.0);
    chart::Felt last;
    for (std::size_t t = 0; t < femur.ticks(); ++t) last = run->tick(femur.pose_at(femur.depth[t + 1]));
    EXPECT_NEAR(-last.wrench[2], 198.4, 0.1);
}

// 00-09: force goes with the feed, and against the speed at a fixed feed rate.
TEST(Tsai2007, ThrustIsProportionalToTheFeed) {
    test::InTheBlock block("000");
    const double d = block.depth();
    (void)block.go(d + 8.0_um);  // a velocity is felt one interval later
    const double once = block.go(d + 24.0_um).wrench[2];
    const double twice = block.go(d + 25.0_um).wrench[2];
    EXPECT_NEAR(twice / once, 2.0, 1e-9);
}

// S-12: bone is not updated while drilling.
TEST(Tsai2007, AFinishedHoleIsFeltAgain) {  // 00-19
    test::InTheBlock block("000");
    for (int i = 1; i <= 20; ++i) (void)block.go(block.depth() - i * 50.0_um);
    (void)block.go(block.depth() - 0.95_mm);
    EXPECT_LT(block.go(block.depth() - 0.9_mm).wrench[2], -1000.0) << "N, where the hole is empty";
}

}  // namespace
}  // namespace kerf::as_printed
