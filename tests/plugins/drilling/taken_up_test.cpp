// SPDX-License-Identifier: Apache-2.0
// What a drill's law works out when it is taken up is that of the drill that was taken up.
#include <gtest/gtest.h>

#include <cstring>
#include <utility>
#include <vector>

#include "tests/support/drill_rig.h"
#include "tests/support/made_outline.h"

namespace kerf {
namespace {

using namespace literals;

Tool tool_of(const ToolSetup& setup) { return {setup, test::outline(setup)}; }

/// Taken up above the bone and fed into it.
struct Drilling {
    Simulation simulation;
    double hand = -2.0_mm;

    Drilling(const Body& body, std::vector<Tool> tools)
        : simulation(body, std::move(tools), test::gains(), test::at_depth(-2.0_mm)) {}
    void feed(double by, double rate = 2.0_mm_per_s) {
        for (const double to = hand + by; hand < to; hand += rate * Simulation::dt) {
            simulation.tick({test::at_depth(hand)});
        }
    }
};

bool is_same(const std::vector<kerf_channel>& a, const std::vector<kerf_channel>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(kerf_channel)) == 0;
}

TEST(TakenUp, AnotherDrillHasItsOwnEdgesAndShank) {
    const Body body = test::block({-8.0_mm, -8.0_mm, -12.0_mm}, {8.0_mm, 8.0_mm, 0.0}, 0.4_mm);
    const Tool thin = tool_of(test::twist_drill({{"diameter", 2.5_mm}})), stepped = tool_of(test::step_drill());
    Drilling only(body, {stepped}), after(body, {thin, stepped});
    after.simulation.take_tool(1);
    only.feed(5.0_mm);
    after.feed(5.0_mm);
    const std::vector<kerf_channel> wanted = test::law_now(only.simulation);
    ASSERT_GE(wanted.size(), 4u) << "it cuts, along and aside";
    EXPECT_TRUE(is_same(test::law_now(after.simulation), wanted));

    Drilling other(body, {thin});
    other.feed(5.0_mm);
    EXPECT_FALSE(is_same(test::law_now(other.simulation), wanted)) << "and that says something";
}

}  // namespace
}  // namespace kerf
