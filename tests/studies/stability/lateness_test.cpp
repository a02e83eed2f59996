// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/stability/lateness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "studies/stability/port.h"
#include "studies/stability/scenes.h"
#include "studies/stability/wall.h"
#include "tests/studies/stability/found_tool.h"

namespace kerf::stability {
namespace {

TEST(Lateness, HasLateTicksTenTimesAsOftenAsMeasured) {
    Lateness lateness;
    constexpr int ticks = 200000;
    int over_period = 0, over_pause = 0, in_time = 0;
    double longest = 0.0;
    for (int i = 0; i < ticks; ++i) {
        const double late = lateness.next(HUGE_VAL);
        ASSERT_GE(late, 0.0);
        over_period += late >= 1e-3;
        over_pause += late >= 2e-3;
        in_time += late < 1e-6;
        longest = std::fmax(longest, late);
    }
    // Of 130 595 measured ticks 91 were more than 1 ms late, 21 more than 2 ms, 127 285 less than 1 µs.
    EXPECT_NEAR(over_period, 10.0 * 91 / 130595 * ticks, 4.0 * std::sqrt(1394.0));
    EXPECT_NEAR(over_pause, 10.0 * 21 / 130595 * ticks, 4.0 * std::sqrt(322.0));
    EXPECT_NEAR(in_time, std::pow(127285.0 / 130595, 10) * ticks, 4.0 * std::sqrt(35000.0));
    EXPECT_GT(longest, 10e-3);
    EXPECT_LE(longest, 20e-3);
}

TEST(Lateness, StaysBelowItsLimit) {
    Lateness lateness;
    for (int i = 0; i < 20000; ++i) ASSERT_LT(lateness.next(3e-3), 3e-3);
}

TEST(Lateness, APortHoldsItsForceUntilTheLoopIsCalled) {
    const PortSettings settings{.mass = 0.1, .viscosity = 0.0, .clock = Clock::measured};
    Port port(settings, 0.0);
    port.step(-1.0, 0.0);  // a force of 1 N towards the bone is held from here on
    int ticks = 1;
    std::uint32_t missed = 0;
    while (missed == 0 && ticks < 1000) {
        missed = port.wait_for_clock(0.0);
        port.step(-1.0, 0.0);
        ticks += 1 + static_cast<int>(missed);
    }
    ASSERT_GT(missed, 0u);
    const double t = 1e-3 * ticks;
    EXPECT_NEAR(port.depth(), 0.5 * (1.0 / 0.1) * t * t, 1e-12) << "no time is lost";
    EXPECT_NEAR(port.work(), -1.0 * port.depth(), 1e-12);
}

TEST(Lateness, ChangesNoVerdictOfAHandAtAPort) {
    Scope late = only("premium-1.5-6dof", test_hands[2], 0);
    const auto pass = [](const Finding& finding) {
        if (finding.method == Method::kerf && finding.hand != led) {
            EXPECT_EQ(finding.outcome, Outcome::pass) << finding.test << ": " << finding.measured;
        }
    };
    late.clock = Clock::without_pauses;
    check_contact(late, pass);
    check_breakthrough(late, the_drill(), pass);
    check_re_entry(late, the_drill(), nullptr, pass);
    late.clock = Clock::measured;
    check_contact(late, pass);
}

}  // namespace
}  // namespace kerf::stability
