// SPDX-License-Identifier: Apache-2.0
// Between pose read and force out a saw allocates nothing, takes no lock and makes no system call, also while the
// worker beside it makes two bodies of the bone that it parts, and the loop takes them over.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/haptics/scene/surface_worker.h"
#include "plugins/sawing/saw_force.h"
#include "tests/support/loop_guard.h"
#include "tests/support/saw_rig.h"

namespace kerf {
namespace {

using namespace literals;

constexpr double outer = 5.0_mm, inner = 3.0_mm;

/// What a hand does in a millisecond: where it holds the saw, and the trigger.
struct Hand {
    Pose pose;
    bool is_on = true;
};

/// Air, speeding up, half through the tube, back out of the slot and in again, bent aside until it binds, the trigger
/// let go and pulled in the slot, a leap, a device that is gone for a while, and through the tube.
std::vector<Hand> eventful_way() {
    std::vector<Hand> way;
    const auto at = [](double depth, double tilt = 0.0) { return test::at_depth(depth, tilt, {0, 0, outer}); };
    const auto go = [&](double from, double to, double rate) {
        const double step = (to > from ? rate : -rate) * Simulation::dt;
        const auto ticks = static_cast<int>((to - from) / step);
        for (int i = 0; i < ticks; ++i) way.push_back({at(from + i * step)});
    };
    go(-1.0_mm, 5.0_mm, 20.0_mm_per_s);
    go(5.0_mm, -2.0_mm, 300.0_mm_per_s);
    go(-2.0_mm, 5.0_mm, 300.0_mm_per_s);
    for (int i = 0; i < 200; ++i) {
        Pose aside = at(5.2_mm);
        aside.position.y += 1.0_mm * std::sin(0.05 * i);
        way.push_back({aside});
    }
    for (int i = 0; i < 150; ++i) way.push_back({at(5.2_mm), false});
    for (int i = 0; i < 300; ++i) way.push_back({at(5.2_mm, 0.02 * std::sin(0.05 * i))});
    for (int i = 0; i < 60; ++i) way.push_back({at(-40.0_mm)});
    Pose gone = at(-40.0_mm);
    gone.rotation.w = std::nan("");
    for (int i = 0; i < 60; ++i) way.push_back({gone});
    go(-3.0_mm, 14.0_mm, 20.0_mm_per_s);
    for (int i = 0; i < 200; ++i) way.push_back({at(14.0_mm)});
    return way;
}

/// A saw on its way through a tube, and the worker.
struct Rig {
    Body body = test::tube(outer, inner, 5.0_mm, 0.25_mm);
    ToolSetup setup = test::saw({{"run_up", 50.0_ms}});
    ToolOutline outline = test::outline(setup);
    HapticLoop haptic{body, setup, outline, test::gains(), test::at_depth(-1.0_mm, 0.0, {0, 0, outer})};
    SurfaceWorker worker{body, {&outline.cutting}, {.crumb = 1e-9}};

    struct Happened {
        bool was_fast = false, was_closed_or_closing = false, has_adopted = false;
    };
    /// All that a loop on the clock does between pose read and force out, and after it.
    Happened loop(const Hand& hand) {
        Happened happened;
        haptic.command_drive(0, hand.is_on ? 200.0 : 0.0);
        const TickResult result = haptic.tick({hand.pose});
        happened.was_fast = result.parts > 1;
        happened.was_closed_or_closing = result.is_closed_or_closing;
        happened.has_adopted = worker.exchange(haptic).separation;
        return happened;
    }
    [[nodiscard]] bool is_offer_due() {
        const Offer* offer = worker.offered();
        return offer != nullptr && offer->tick + HapticLoop::adoption_delay <= haptic.ticks() + 1;
    }
};

TEST(SawLoop, NeitherAllocatesNorLocksNorThrowsThroughASplit) {
    Rig rig;
    Rig::Happened ever;
    const std::vector<Hand> way = eventful_way();
    double bound = 0.0;
    for (std::size_t i = 0; i < way.size(); ++i) {
        const test::Forbidden before = test::forbidden_here();
        const Rig::Happened now = rig.loop(way[i]);
        ASSERT_EQ(test::forbidden_here(), before) << "tick " << i;
        ever.was_fast = ever.was_fast || now.was_fast;
        ever.was_closed_or_closing = ever.was_closed_or_closing || now.was_closed_or_closing;
        ever.has_adopted = ever.has_adopted || now.has_adopted;
        bound = std::max(bound, signals_of<sawing::SawCutting>(rig.haptic.signals()).binding);
        rig.haptic.make_room();
        if (i % 10 == 0) rig.worker.wait_for_all();  // however slow this machine is
    }
    EXPECT_TRUE(ever.was_fast && ever.was_closed_or_closing && ever.has_adopted) << "the way was eventful";
    EXPECT_GT(bound, 1.0) << "N: it was bent until it bound";
    EXPECT_EQ(rig.haptic.bodies().size(), 2u);
    EXPECT_EQ(rig.worker.lost(), 0u);
}

TEST(SawLoop, MakesNoSystemCallThroughASplit) {
    Rig rig;
    const std::vector<Hand> way = eventful_way();
    bool has_adopted = false;
    for (std::size_t i = 0; i < way.size(); ++i) {
        // A child costs a few milliseconds: now and then a tick in one, and the tick that takes the parts over.
        const bool is_due = rig.is_offer_due();
        if (i % 40 == 0 || is_due) {
            const auto calls = test::system_calls_of([&] { (void)rig.loop(way[i]); });
            if (calls == test::SystemCalls::cannot_tell)
                GTEST_SKIP() << "this kernel does not let a process forbid itself system calls";
            ASSERT_EQ(calls, test::SystemCalls::none) << "tick " << i;
        }
        const bool adopts = rig.loop(way[i]).has_adopted;
        EXPECT_TRUE(!adopts || is_due);
        has_adopted = has_adopted || adopts;
        rig.haptic.make_room();
        rig.worker.wait_for_all();  // so that what is due now is known now
    }
    EXPECT_TRUE(has_adopted);
}

}  // namespace
}  // namespace kerf
