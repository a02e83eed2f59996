// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/stability/port.h"

#include <gtest/gtest.h>

#include <cmath>

namespace kerf::stability {
namespace {

TEST(Port, AForceThatIsHeldDrivesABareMassAlongAParabola) {
    Port port({.mass = 0.1, .viscosity = 0.0}, 0.0);
    for (int i = 0; i < 100; ++i) port.step(-0.2, 0.0);
    EXPECT_NEAR(port.depth(), 0.5 * (0.2 / 0.1) * 0.1 * 0.1, 1e-12);
    EXPECT_NEAR(port.rate(), 0.2, 1e-12);
}

TEST(Port, ALetGoHandSwingsAtItsOwnFrequencyAndLosesWhatItsDampingTakes) {
    const TestHand hand{"swing", 0.4, 0.5, 500.0};
    Port port({.mass = 0.1, .viscosity = 0.0, .hand = hand, .period = 2e-3}, 0.0);
    port.place(1e-3, 0.0);
    for (int i = 0; i < 100; ++i) port.step(0.0, 0.0);
    const double decay = 0.5 * 0.5 / 0.5, omega = std::sqrt(500.0 / 0.5 - decay * decay), t = 0.2;
    const double expected = 1e-3 * std::exp(-decay * t) * (std::cos(omega * t) + decay / omega * std::sin(omega * t));
    EXPECT_NEAR(port.depth(), expected, 2e-3 * 1e-3 /* steps of 0.1 ms, second order */);
}

TEST(Port, FrictionHoldsWhatIsWeakerAndTakesItsPartOfWhatIsStronger) {
    Port port({.mass = 0.1, .viscosity = 0.0, .friction = 0.3}, 0.0);
    for (int i = 0; i < 100; ++i) port.step(0.0, 0.29);
    EXPECT_EQ(port.depth(), 0.0);
    for (int i = 0; i < 100; ++i) port.step(0.0, 0.5);
    EXPECT_NEAR(port.rate(), (0.5 - 0.3) / 0.1 * 0.1, 1e-12);
}

TEST(Port, ADelayedForceArrivesThatManyTicksLater) {
    for (int delay = 0; delay <= max_latency; ++delay) {
        Port port({.delay = delay}, 0.0);
        for (int tick = 0; tick < 5; ++tick) {
            port.step(1.0 + tick, 0.0);
            EXPECT_EQ(port.held(), tick < delay ? 0.0 : 1.0 + tick - delay) << delay << " ticks, tick " << tick;
        }
        port.step_unanswered(0.0);
        EXPECT_EQ(port.held(), delay == 0 ? 5.0 : 6.0 - delay) << "what was under way still arrives";
        port.step_unanswered(0.0);
        port.step_unanswered(0.0);
        EXPECT_EQ(port.held(), 5.0);
    }
}

TEST(Port, TheEncoderSaysWholeCounts) {
    Port port({.resolution = 30e-6}, 100e-6);
    EXPECT_DOUBLE_EQ(port.reported(), 90e-6);
}

}  // namespace
}  // namespace kerf::stability
