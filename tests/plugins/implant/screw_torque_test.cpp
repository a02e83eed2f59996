// SPDX-License-Identifier: Apache-2.0
// Torque over angle: of a screw that goes in, seats, is tightened, strips and is turned out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/plugins/implant/screw_rig.h"
#include "tests/plugins/implant/weidling.h"

namespace kerf {
namespace {

using namespace literals;
using test::ScrewRig;

constexpr double fast = 4.0 * pi;  // [rad/s], two turns a second: nothing depends on it

std::map<std::string, double> parameters_of(const test::MeasuredScrew& s) {
    const implant::ScrewThread t = test::thread_of(s);
    return {{"outer_diameter", t.outer}, {"core_diameter", t.core},   {"tip_core_diameter", t.core_at_tip},
            {"pitch", t.pitch},          {"thread_length", t.length}, {"flutes", 0.0},
            {"flute_length", 0.0},       {"head_diameter", t.head}};
}

TEST(ScrewTorque, OfMeasuredScrewsIsFoundWithNothingFitted) {
    double sum = 0.0;
    for (const test::MeasuredScrew& s : test::weidling) {
        ScrewRig rig(test::weidling_density, parameters_of(s), Simulation::dt, 40.0_mm, test::pilot_radius_of(s));
        rig.insert(25.0_mm / s.pitch, fast);
        const double found = rig.signals().torque, error = std::abs(found / s.torque - 1.0);
        RecordProperty(s.name, std::to_string(found));
        sum += error;
        EXPECT_LT(error, 0.45) << s.name << ": " << found << " N·m for " << s.torque;
    }
    EXPECT_LT(sum / 12.0, 0.18) << "mean error";
    RecordProperty("mean_error", std::to_string(sum / 12.0));
}

// P5, and E02-9 of paper 002: what strips, strips by its slip.
TEST(ScrewTorque, OverAngleDoesNotDependOnTheLoopRate) {
    const auto torques = [](double period) {
        ScrewRig rig(300.0, {}, period);
        rig.insert(2.0, fast);
        std::vector<double> all;
        for (int i = 0; i < 20; ++i) {
            rig.turn(0.5, fast);
            all.push_back(rig.signals().torque);
        }
        return all;
    };
    const auto at_1_khz = torques(1e-3);
    for (const double period : {2e-3, 0.5e-3, 0.25e-3}) {
        const auto other = torques(period);
        for (std::size_t i = 0; i < other.size(); ++i)
            EXPECT_NEAR(other[i], at_1_khz[i], 0.02 * at_1_khz.back()) << 1.0 / period << " Hz, at " << i;
    }
}

TEST(ScrewTorque, DoesNotDependOnTheSpeed) {
    const auto torque = [](double speed) {
        ScrewRig rig(300.0);
        rig.insert(4.0, speed);
        return rig.signals().torque;
    };
    EXPECT_NEAR(torque(fast), torque(0.25 * fast), 0.02 * torque(fast));
}

TEST(ScrewTorque, RisesWithDepthAndDensity) {
    double last = 0.0;
    ScrewRig rig(300.0);
    rig.insert(1.0, fast);
    for (int i = 0; i < 8; ++i) {
        rig.turn(2.0 * pi, fast);
        EXPECT_GT(rig.signals().torque, last) << i;
        last = rig.signals().torque;
    }
    ScrewRig soft(150.0);
    soft.insert(9.0, fast);
    EXPECT_LT(soft.signals().torque, 0.5 * last);
}

// Wu 2022: more or longer flutes lower it, a double lead raises it. A wider pilot hole lowers it.
TEST(ScrewTorque, HasTheSignsThatWereMeasured) {
    const auto torque = [](const std::map<std::string, double>& set, double hole = 0.0) {
        ScrewRig rig(320.0, set, Simulation::dt, 55.0_mm, hole);
        rig.insert(24.0_mm / (set.contains("starts") ? 5.5_mm : 2.75_mm), fast);
        return rig.signals().torque;
    };
    const double plain = torque({});
    EXPECT_GT(plain, 0.1);
    EXPECT_LT(torque({{"flutes", 3.0}}), plain);
    EXPECT_LT(torque({{"flute_length", 10.0_mm}}), plain);
    EXPECT_GT(torque({{"starts", 2.0}}), plain);
    EXPECT_LT(torque({}, 2.4_mm), plain) << "a hole of 4.8 mm";
}

/// Torque of 20 mm of thread with a cylindrical core of 4 mm and no flutes, in a hole of `hole` [m] across.
double torque_in_hole(double hole) {
    ScrewRig rig(600.0,
                 {{"core_diameter", 4.0_mm},
                  {"tip_core_diameter", 4.0_mm},
                  {"outer_diameter", 6.0_mm},
                  {"thread_length", 26.0_mm},
                  {"flutes", 0.0},
                  {"flute_length", 0.0}},
                 Simulation::dt, 40.0_mm, 0.5 * hole);
    rig.insert(20.0_mm / rig.thread().pitch, fast);
    return rig.signals().torque;
}

// Bone in front of the crests alone presses on them: π (R² − h²)/P on each length, at (R + h)/2 on average.
TEST(FitOfAHole, LeavesToTheFlanksWhatIsBetweenHoleAndCrest) {
    const auto of_flanks = [](double hole) {
        const double crest = 3.0_mm, inner = 0.5 * hole;
        return (crest * crest - inner * inner) * (crest + inner);
    };
    const double widest = torque_in_hole(5.4_mm);
    for (const double hole : {4.2_mm, 4.6_mm, 5.0_mm})
        EXPECT_NEAR(torque_in_hole(hole) / widest, of_flanks(hole) / of_flanks(5.4_mm),
                    0.06 * of_flanks(hole) / of_flanks(5.4_mm))
            << hole;
    EXPECT_EQ(torque_in_hole(6.2_mm), 0.0) << "it meets no bone";
}

// 2 D_c (R_o + R_c)/2 of the core, for (R_o² − R_c²)/P (R_o + R_c)/2 of the flanks.
TEST(FitOfAHole, LetsBonePressOnACoreThatIsWider) {
    const double flanks = torque_in_hole(4.04_mm), pressed = torque_in_hole(3.6_mm);
    const double pitch = ScrewRig(600.0).thread().pitch;
    EXPECT_NEAR(pressed / flanks, 1.0 + 4.0_mm * pitch / (9.0_mm * 1.0_mm - 4.0_mm * 1.0_mm), 0.05 * pressed / flanks);
    EXPECT_NEAR(torque_in_hole(3.2_mm), pressed, 0.02 * pressed) << "the pressure is full by then";
    const double half = torque_in_hole(3.964_mm);  // 0.9 %
    EXPECT_GT(half, flanks + 0.3 * (pressed - flanks));
    EXPECT_LT(half, flanks + 0.7 * (pressed - flanks));
}

/// Turned until the head is `force` on its seat, or for so many radians.
double tighten(ScrewRig& rig, double force) {
    for (int i = 0; i < 4000 && rig.signals().clamp < force; ++i) rig.turn(0.01, 0.5 * pi);
    return rig.signals().torque;
}

const std::map<std::string, double> short_screw = {{"thread_length", 25.0_mm}};

// C.10: T = F (P/2π + μ r_t/cos β + μ r_h). It comes out of the channels: no term of the law is this.
TEST(Tightening, TurnsTorqueIntoClampForceAsABoltDoes) {
    ScrewRig rig(700.0, short_screw);
    rig.insert(6.0, fast);
    tighten(rig, 1.0);
    const double going_in = rig.signals().torque;
    const double torque = tighten(rig, 1000.0), clamp = rig.signals().clamp;
    ASSERT_GT(clamp, 950.0);
    const implant::ScrewThread& t = rig.thread();
    const double mu = 0.3, thread_radius = t.mean_radius(-0.5 * t.length), head_radius = 0.25 * (t.outer + t.head);
    const double bolt = clamp * (t.advance() + mu * thread_radius / std::cos(t.flank_angle) + mu * head_radius);
    EXPECT_NEAR((torque - going_in) / bolt, 1.0, 0.05) << torque << " of it going in " << going_in;
}

TEST(Tightening, StripsBySlipAndReportsItsPhases) {
    ScrewRig rig(250.0, short_screw);
    rig.insert(6.0, fast);
    tighten(rig, 1.0);
    const double seated = rig.angle();
    double most = 0.0, max_at = 0.0;
    std::vector<std::pair<double, double>> curve;
    for (int i = 0; i < 1200; ++i) {
        rig.turn(0.01, 0.5 * pi);
        curve.emplace_back(rig.angle() - seated, rig.signals().torque);
        if (curve.back().second > most) most = curve.back().second, max_at = curve.back().first;
    }
    EXPECT_GT(max_at, 60.0_deg);
    EXPECT_LT(max_at, 360.0_deg);
    for (const auto& [angle, torque] : curve) {
        if (angle > max_at + 2.0 * pi) {
            EXPECT_LT(torque, 0.3 * most) << angle;
        }
    }
    const std::vector<std::string> wanted{"implant.going_in", "implant.head_contact", "implant.yield",
                                          "implant.slipped", "implant.stripped"};
    EXPECT_EQ(rig.events(), wanted);
}

// E02-11: a driver that rests is held by friction, whichever way it is turned next.
TEST(ScrewAtRest, IsHeldByFrictionEitherWay) {
    ScrewRig rig(300.0);
    rig.insert(5.0, fast);
    const double going_in = rig.signals().torque;
    std::vector<kerf_channel> channels(KERF_MAX_CHANNELS);
    kerf_law law{sizeof(kerf_law), 0, channels.data(), {}, {}};
    const kerf_tick_in in = tick_in_of(rig.rig().setup(), rig.rig().bone().query(), Simulation::dt);
    ASSERT_EQ(rig.rig().setup().force->force->resist(&in, rig.rig().state(), &law), KERF_OK);
    double held = 0.0;
    for (std::uint32_t c = 0; c < law.count; ++c)
        if (channels[c].kind == KERF_FRICTION) {
            held += channels[c].tau * channels[c].d[5];
            EXPECT_LE(channels[c].w, 1e-6) << "it does not creep";
        }
    EXPECT_NEAR(held, going_in, 0.2 * going_in);
}

TEST(ScrewBackingOut, ComesOutAlongItsThreadWithLessTorque) {
    ScrewRig rig(300.0);
    rig.insert(6.0, fast);
    const double in = rig.signals().torque, deep = rig.depth();
    rig.turn(-4.0 * pi, fast);
    EXPECT_NEAR(deep - rig.depth(), 2.0 * rig.thread().lead(), 0.1 * rig.thread().lead());
    EXPECT_LT(rig.signals().torque, 0.0) << "against the turn";
    EXPECT_LT(-rig.signals().torque, in);
    EXPECT_EQ(rig.events().back(), "implant.backing_out");
}

}  // namespace
}  // namespace kerf
