// SPDX-License-Identifier: Apache-2.0
// Between pose read and force out: no allocation, no lock, no system call, no throw. Whatever happens in the tick.
#include "tests/support/loop_guard.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/drill_rig.h"
#include "tests/support/rig.h"

namespace kerf {
namespace {

using namespace literals;

/// Everything a drill goes through: air, running up, cutting, drawing back, coming again, leaping, a device that is
/// gone.
std::vector<Pose> eventful_way() {
    std::vector<Pose> way;
    const auto go = [&](double from, double to, double rate) {
        for (double depth = from; (to - depth) * (to > from ? 1.0 : -1.0) > 0.0;
             depth += (to > from ? rate : -rate) * Simulation::dt)
            way.push_back(test::at_depth(depth));
    };
    go(-6.0_mm, 1.5_mm, 8.0_mm_per_s);
    go(1.5_mm, 12.0_mm, 20.0_mm_per_s);
    go(12.0_mm, -8.0_mm, 500.0_mm_per_s);
    go(-8.0_mm, 13.0_mm, 500.0_mm_per_s);
    for (int i = 0; i < 100; ++i) way.push_back(test::at_depth(60.0_mm));
    Pose gone = test::at_depth(60.0_mm);
    gone.rotation.w = std::nan("");
    for (int i = 0; i < 100; ++i) way.push_back(gone);
    go(60.0_mm, 62.0_mm, 10.0_mm_per_s);
    for (int i = 0; i < 300; ++i) way.push_back(test::at_depth(62.0_mm, 0.02 * std::sin(0.05 * i)));
    return way;
}

/// The drill above a block.
test::Rig above_block(const ToolSetup& setup = test::twist_drill(), double thickness = 8.0_mm) {
    return {test::block({-5.0_mm, -5.0_mm, -thickness}, {5.0_mm, 5.0_mm, 0}, 0.25_mm, {0.3, 0.1, 0.7}), setup,
            test::at_depth(-6.0_mm)};
}

/// Of two readings of this thread.
void expect_nothing_forbidden(const test::Forbidden& before, const test::Forbidden& after, std::size_t tick) {
    ASSERT_EQ(after.allocations, before.allocations) << "tick " << tick;
    ASSERT_EQ(after.locks, before.locks) << "tick " << tick;
    ASSERT_EQ(after.throws, before.throws) << "tick " << tick;
}

TEST(LoopGuard, SeesWhatItIsForbidden) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "a sanitizer brings its own heap and locks";
#endif
    std::mutex mutex;
    const test::Forbidden before = test::forbidden_here();
    { const std::lock_guard lock(mutex); }
    EXPECT_EQ(test::forbidden_here().locks, before.locks + 1);
    try {
        throw std::runtime_error("on purpose");
    } catch (const std::runtime_error&) {
    }
    EXPECT_EQ(test::forbidden_here().throws, before.throws + 1);
    void* volatile memory = std::malloc(10);
    std::free(memory);
    EXPECT_GE(test::forbidden_here().allocations, before.allocations + 2);
    const auto calls = test::system_calls_of([] { std::this_thread::sleep_for(std::chrono::microseconds(1)); });
    EXPECT_NE(calls, test::SystemCalls::none);
}

TEST(LoopGuard, TheTickNeitherAllocatesNorLocksNorThrows) {
    test::Rig rig = above_block();
    const std::vector<Pose> way = eventful_way();
    bool was_fast = false, was_closed_or_closing = false;
    for (std::size_t i = 0; i < way.size(); ++i) {
        const test::Forbidden before = test::forbidden_here();
        const TickResult result = rig.loop().tick({way[i]});
        const test::Forbidden after = test::forbidden_here();
        ASSERT_NO_FATAL_FAILURE(expect_nothing_forbidden(before, after, i));
        was_fast = was_fast || result.parts > 1;
        was_closed_or_closing = was_closed_or_closing || result.is_closed_or_closing;
        rig.follow();
    }
    EXPECT_TRUE(was_fast && was_closed_or_closing) << "the way was eventful";
    EXPECT_GT(way.size(), 2000u);
}

TEST(LoopGuard, NorWhileATipThatDoesNotTurnStandsCrushesAndBreaksThrough) {
    test::Rig rig = above_block(test::twist_drill({{"spindle_speed", 0.0}}), 2.0_mm);
    std::vector<std::string> happened;
    for (std::size_t i = 0; i < 4000; ++i) {
        const DeviceSample hand{test::at_depth(-0.2_mm + 2.0_um * static_cast<double>(i))};
        const test::Forbidden before = test::forbidden_here();
        const TickResult result = rig.loop().tick_direct(hand);
        const test::Forbidden after = test::forbidden_here();
        ASSERT_NO_FATAL_FAILURE(expect_nothing_forbidden(before, after, i));
        for (std::size_t n = 0; n < result.event_count; ++n) happened.emplace_back(result.events[n]);
        rig.follow();
    }
    EXPECT_EQ(happened, (std::vector<std::string>{"drilling.crushing", "drilling.wall_broken"}));
}

TEST(LoopGuard, TheTickMakesNoSystemCall) {
    test::Rig rig = above_block();
    const std::vector<Pose> way = eventful_way();
    constexpr std::size_t stretch = 25;  // ticks in one child
    for (std::size_t i = 0; i + stretch < way.size(); i += 4 * stretch) {
        const auto calls = test::system_calls_of([&] {
            for (std::size_t t = 0; t < stretch; ++t) (void)rig.loop().tick({way[i + t]});
        });
        if (calls == test::SystemCalls::cannot_tell)
            GTEST_SKIP() << "this kernel does not let a process forbid itself system calls";
        ASSERT_EQ(calls, test::SystemCalls::none) << "between ticks " << i << " and " << i + stretch;
        for (std::size_t t = 0; t < 4 * stretch && i + t < way.size(); ++t) {
            (void)rig.tick({way[i + t]});
        }
    }
}

}  // namespace
}  // namespace kerf
