// SPDX-License-Identifier: Apache-2.0
// A saw that does not go only touches, and the motor has its limits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>

#include "plugins/sawing/saw_force.h"
#include "tests/support/rig.h"
#include "tests/support/saw_rig.h"

namespace kerf {
namespace {

using namespace literals;

Body wide_block(double spacing = 0.25_mm) {
    return test::block({-18.0_mm, -4.0_mm, -9.0_mm}, {18.0_mm, 4.0_mm, 0}, spacing, {0.31, 0.17, 0.73});
}

// 03-11, S-07: the touch pushes out, in and out alike, and cuts nothing.
TEST(StillSaw, OnlyTouches) {
    test::Rig simulation(wide_block(), test::saw({{"stroke_rate", 0.0}}), test::at_depth(-0.5_mm));
    const auto at = [&](double depth) {
        const TickResult r = simulation.tick_direct({test::at_depth(depth)});
        return r.thrust;
    };
    double work = 0.0, peak = 0.0, last = 0.0;
    for (int i = -100; i <= 300; ++i) {  // in by 0.1 mm and out again
        const double thrust = at((i <= 100 ? i : 200 - i) * 1.0_um);
        work -= 0.5 * (last + thrust) * (i <= 100 ? 1.0_um : -1.0_um);
        peak = std::max(peak, thrust);
        last = thrust;
    }
    EXPECT_GT(peak, 5.0) << "N, at 0.1 mm";
    EXPECT_LE(work, 1e-3 * peak * 0.1_mm /* steps of a micrometre */) << "it gives back no more than it took";
    EXPECT_EQ(at(-0.2_mm), 0.0);
    simulation.finish();
    const double removed = simulation.present().removed();
    EXPECT_EQ(removed, 0.0);
}

/// A hand that holds the handle where it is; the saw finds its own place under the spring of the coupling.
struct Held {
    Body body = wide_block();
    ToolSetup setup;
    Simulation simulation;
    double hand = -0.2_mm;

    explicit Held(const std::map<std::string, double>& set)
        : setup(test::saw(set)),
          simulation(body, setup, test::outline(setup), test::gains(), test::at_depth(-0.2_mm)) {}
    TickResult tick(double speed) {
        hand += speed * Simulation::dt;
        const TickResult r = simulation.tick({test::at_depth(hand)});
        return r;
    }
};

// S-19: switched off under a push the teeth hand over to contact.
TEST(StillSaw, SwitchedOffUnderPushItStopsCuttingAndStands) {
    Held saw({{"run_up", 200.0_ms}});
    double push = 0.0;
    for (int i = 0; i < 6000 && push < 60.0; ++i) push = saw.tick(3.0_mm_per_s).thrust;
    ASSERT_GT(push, 30.0) << "N, while it cuts";
    saw.simulation.command_drive(0, 0.0);
    double largest_step = 0.0, last = saw.tick(0.0).thrust;
    for (int i = 0; i < 500; ++i) {
        const double now = saw.tick(0.0).thrust;
        largest_step = std::max(largest_step, std::abs(now - last));
        last = now;
    }
    RecordProperty("largest_step_percent", std::to_string(100.0 * largest_step / push));
    EXPECT_LT(largest_step, 0.07 * push);
    EXPECT_EQ(signals_of<sawing::SawCutting>(saw.simulation.signals()).stroke_rate, 0.0);
    const double depth = saw.simulation.world_from_tool().position.z;
    for (int i = 0; i < 500; ++i) (void)saw.tick(0.0);
    EXPECT_NEAR(saw.simulation.world_from_tool().position.z, depth, 2.0_um) << "it stands";
}

TEST(SawMotor, RunsUpInItsTimeAndHoldsItsRate) {
    Held saw({{"run_up", 200.0_ms}});
    for (int i = 0; i < 100; ++i) (void)saw.tick(0.0);
    EXPECT_NEAR(signals_of<sawing::SawCutting>(saw.simulation.signals()).stroke_rate, 100.0, 2.0)
        << "half of 12000 a minute, in half of the time";
    for (int i = 0; i < 200; ++i) (void)saw.tick(0.0);
    EXPECT_NEAR(signals_of<sawing::SawCutting>(saw.simulation.signals()).stroke_rate, 200.0, 1e-6);
}

TEST(SawMotor, AWeakMotorBogsDownAndStalls) {
    Held saw({{"run_up", 200.0_ms}, {"motor_torque", 20.0_Nmm}});
    for (int i = 0; i < 800; ++i) (void)saw.tick(0.0);  // in air: the weak motor is slow as well
    std::string events;
    for (int i = 0; i < 3000; ++i) {
        const TickResult r = saw.tick(3.0_mm_per_s);
        for (std::size_t e = 0; e < r.event_count; ++e) events += std::string(r.events[e]) + " ";
    }
    EXPECT_NE(events.find("sawing.bogging"), std::string::npos) << events;
    EXPECT_NE(events.find("sawing.stalled"), std::string::npos) << events;
}

// The law is pure, sound and free of surprises at any pose: near, in and through bone, going and still.
TEST(SawLaw, IsSoundAnywhere) {
    for (const double strokes : {0.0, 20.0, 99.0, 101.0, 400.0}) {
        test::Rig simulation(wide_block(0.5_mm),
                             test::saw({{"stroke_rate", strokes}, {"tooth_count", 40.0}, {"tooth_pitch", 0.6_mm}}),
                             test::at_depth(-1.0_mm));
        for (int i = 0; i < 3000; ++i) {
            const double t = 1e-3 * i;
            Pose pose = test::at_depth(4.0_mm * std::sin(3.0 * t), 0.3 * std::sin(5.0 * t),
                                       {3.0_mm * std::sin(7.0 * t), 2.0_mm * std::sin(2.0 * t), 0});
            pose.rotation =
                pose.rotation * quat_from_rotation_vector({0.2 * std::sin(4.0 * t), 0.0, 0.5 * std::sin(t)});
            const TickResult r = simulation.tick({pose});
            ASSERT_FALSE(r.is_quarantined) << strokes << " at tick " << i;
            for (const double w : r.bone_on_tool) ASSERT_TRUE(std::isfinite(w));
        }
    }
}

}  // namespace
}  // namespace kerf
