// SPDX-License-Identifier: Apache-2.0
// The torque that twists a straight blade about its long axis, and its warning (04-07).
#include "plugins/sawing/blade_torque.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "plugins/sawing/reciprocating_force.h"
#include "tests/support/rig.h"
#include "tests/support/saw_rig.h"

namespace kerf {
namespace {

using namespace literals;
using sawing::ReciprocatingCutting;
using sawing::StraightBlade;
using sawing::TwistWatch;

constexpr StraightBlade ten_high{.length = 50.0_mm,
                                 .height = 10.0_mm,
                                 .travel = 3.0_mm,
                                 .pitch = 2.0_mm,
                                 .tooth_count = 25,
                                 .thickness = 0.8_mm,
                                 .set = 0.1_mm,
                                 .tooth_height = 1.0_mm};

/// Contacts of which each carries `force` [N]: `along` is the direction in which the tool presses.
struct Contact {
    Vec3 at, along;
    double force;
};
double torque_of(const std::vector<Contact>& contacts) {
    std::vector<kerf_channel> channels;
    std::vector<double> lambda;
    for (const Contact& one : contacts) {
        kerf_channel c{};
        const Vec6 d = rate_at(one.at, one.along);
        std::copy(d.begin(), d.end(), c.d);
        channels.push_back(c);
        lambda.push_back(one.force);
    }
    Advance advance;
    advance.channel = channels;
    advance.lambda = lambda;
    return sawing::blade_torque(advance, ten_high);
}

TEST(BladeTorque, IsForceTimesArmOfBothEdges) {
    // Given 4 N on the cutting edge's −y side and 4 N on the back edge's +y side, each 5 mm from the long axis
    const Contact cutting{{7.0_mm, -0.4_mm, 0.0}, {0, -1, 0}, 4.0}, back{{7.0_mm, 0.4_mm, -10.0_mm}, {0, 1, 0}, 4.0};
    // Bone pushes the cutting edge to +y: (p × f)_x = −z f_y; z is +5 mm there, −5 mm at the back edge
    EXPECT_NEAR(torque_of({cutting}), -4.0 * 5.0_mm, 1e-15);
    EXPECT_NEAR(torque_of({back}), -4.0 * 5.0_mm, 1e-15);
    EXPECT_NEAR(torque_of({cutting, back}), -40.0_Nmm, 1e-15);
}

TEST(BladeTorque, IsNoneWhenTheBladeIsPushedAside) {
    EXPECT_NEAR(torque_of({{{0, 0.4_mm, 0.0}, {0, 1, 0}, 3.0}, {{0, 0.4_mm, -10.0_mm}, {0, 1, 0}, 3.0}}), 0.0, 1e-15);
    EXPECT_NEAR(torque_of({{{20.0_mm, 0.0, 0.0}, {0, 0, 1}, 50.0}}), 0.0, 1e-15) << "nor by the thrust of a tooth";
}

TEST(TwistWatch, WarnsOnceAndAgainAfterRearming) {
    TwistWatch watch;
    int warned = 0;
    const auto step = [&](double torque) { warned += watch.step(torque, 1.0, true, 1e-3); };
    step(0.99);
    EXPECT_EQ(warned, 0);
    step(-1.01);  // either sense
    EXPECT_EQ(warned, 1);
    step(1.2);
    step(0.81);  // not yet below 0.8
    step(1.2);
    EXPECT_EQ(warned, 1);
    step(0.79);
    step(1.2);
    EXPECT_EQ(warned, 2);
}

TEST(TwistWatch, CountsTheFractionOfTheTimeInBone) {
    TwistWatch watch;
    EXPECT_EQ(watch.exceedance(), 0.0);
    for (int i = 0; i < 3; ++i) (void)watch.step(0.5, 1.0, true, 1e-3);
    (void)watch.step(1.5, 1.0, true, 1e-3);
    (void)watch.step(1.5, 1.0, false, 1e-3);  // in air
    EXPECT_NEAR(watch.exceedance(), 0.25, 1e-12);
}

/// A saw 9 mm deep in its slot, drawn back by half a millimetre: the back edge is in the bone.
struct InItsSlot {
    test::Rig simulation;
    Pose still;
    double threshold;

    explicit InItsSlot(const std::map<std::string, double>& more = {})
        : simulation(test::block({-14.0_mm, -5.0_mm, -16.0_mm}, {14.0_mm, 5.0_mm, 0}, 0.25_mm, {0.31, 0.17, 0.73}),
                     test::reciprocating_saw(set(more)), test::at_depth(-1.0_mm)) {
        for (double depth = -1.0_mm; depth < 12.0_mm; depth += 6.0_um)
            (void)simulation.tick_direct({test::at_depth(depth)});
        for (double depth = 12.0_mm; depth > 11.5_mm; depth -= 10.0_um)
            (void)simulation.tick_direct({test::at_depth(depth)});
        still = simulation.world_from_tool();
        threshold = value_of<ReciprocatingCutting>(simulation.setup().force_parameters).torque_threshold;
    }
    static std::map<std::string, double> set(std::map<std::string, double> more) {
        more.insert({{"blade_length", 20.0_mm}, {"tooth_pitch", 2.0_mm}, {"blade_height", 8.0_mm}});
        return more;
    }
    struct Now {
        double torque;
        int warnings = 0;
    };
    /// Twisted by `angle` [rad] about the blade's long axis, half way between its edges.
    Now twist(double angle) {
        const Vec3 axis{0, 0, -4.0_mm};
        const Quat turn = quat_from_rotation_vector({angle, 0, 0});
        const TickResult r = simulation.tick_direct({still * Pose{axis - rotate(turn, axis), turn}});
        Now now{signals_of<ReciprocatingCutting>(simulation.signals()).blade_torque};
        for (std::size_t e = 0; e < r.event_count; ++e)
            now.warnings += std::string_view(r.events[e]) == "sawing.twisted";
        return now;
    }
};

TEST(TwistedBlade, IsTwistedBackTheMoreItIsTwisted) {  // 04-07
    InItsSlot plus, minus;
    double last = 0.0;
    for (int i = 0; i <= 800; ++i) {
        const double angle = i * 0.01_deg, torque = plus.twist(angle).torque, mirrored = minus.twist(-angle).torque;
        if (i > 0 && i % 200 == 0) {
            EXPECT_LT(torque, last - 1.0_Nmm) << "against the twist, at " << i / 100 << " deg";
            EXPECT_NEAR(mirrored, -torque, 0.05 * std::abs(torque)) << "the mirrored twist";
            RecordProperty("Nmm_at_" + std::to_string(i / 100) + "_deg", std::to_string(torque / 1.0_Nmm));
            last = torque;
        }
        if (angle < 1.0_deg) {
            EXPECT_LT(std::abs(torque), 1.0_Nmm) << "free within its set";
        }
    }
}

TEST(TwistedBlade, WarnsInTheTickInWhichTheTorqueCrossesTheThreshold) {
    InItsSlot saw({{"torque_threshold", 20.0_Nmm}});
    int warnings = 0, crossed_at = -1, warned_at = -1;
    for (int i = 0; i <= 1000; ++i) {
        const InItsSlot::Now now = saw.twist(i * 0.01_deg);
        if (crossed_at < 0 && std::abs(now.torque) > saw.threshold) crossed_at = i;
        if (warned_at < 0 && now.warnings > 0) warned_at = i;
        warnings += now.warnings;
    }
    ASSERT_GE(crossed_at, 0);
    EXPECT_LE(std::abs(warned_at - crossed_at), 1);
    EXPECT_EQ(warnings, 1) << "and once";
    for (int i = 1000; i >= 0; --i) (void)saw.twist(i * 0.01_deg);
    for (int i = 0; i <= 1000; ++i) warnings += saw.twist(i * 0.01_deg).warnings;
    EXPECT_EQ(warnings, 2) << "armed again";
    const double fraction = signals_of<ReciprocatingCutting>(saw.simulation.signals()).torque_exceedance;
    EXPECT_GT(fraction, 0.05);
    EXPECT_LT(fraction, 0.8);
}

TEST(TwistedBlade, CutStraightIsNotTwisted) {
    InItsSlot saw;
    EXPECT_EQ(signals_of<ReciprocatingCutting>(saw.simulation.signals()).torque_exceedance, 0.0);
}

}  // namespace
}  // namespace kerf
