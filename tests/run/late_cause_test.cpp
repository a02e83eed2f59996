// SPDX-License-Identifier: Apache-2.0
// Why a tick was late: from made-up counters, and from a thread that does on purpose what makes ticks late.
#include "run/clock/late_cause.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <numeric>
#include <thread>
#include <vector>

#include "run/clock/wall_clock.h"

namespace kerf::run {
namespace {

constexpr std::int64_t ms = 1'000'000, us = 1000;
constexpr std::int64_t period = ms;

/// A tick that was due at 100 ms.
TickTrace tick(std::int64_t lateness, std::int64_t length, std::int64_t computed) {
    TickTrace trace;
    trace.tick = 100;
    trace.due = 100 * ms;
    trace.begun = trace.due + lateness;
    trace.done = trace.begun + length;
    trace.computed = computed;
    trace.missed = static_cast<std::uint32_t>(lateness / period);
    return trace;
}

/// Samples each millisecond from 90 to 140 ms of a thread that waits for a core from `from` on for `waited`.
std::vector<ThreadSample> samples(std::int64_t from, std::int64_t waited, bool is_blocked = false) {
    std::vector<ThreadSample> all;
    for (int i = 90; i < 140; ++i) {
        ThreadSample& one = all.emplace_back();
        one.at = i * ms;
        one.begun = one.at - 20 * us;
        one.waited = one.at <= from ? 0 : std::min<std::int64_t>(one.at - from, waited);
        one.is_blocked = is_blocked && one.at > from && one.at < from + 5 * ms;
        one.faults = one.at > from ? 7 : 0;
    }
    return all;
}

TEST(LateCause, IsTheCoreIfTheThreadWaitedForOne) {
    const ExplainedTick found = explain(tick(5 * ms, 50 * us, 40 * us), nullptr, samples(100 * ms, 5 * ms), period);
    EXPECT_EQ(found.cause, LateCause::core_taken);
    EXPECT_EQ(found.faults, 7u);
}

TEST(LateCause, IsTheMachineIfTheThreadNeitherWaitedNorComputed) {
    EXPECT_EQ(explain(tick(5 * ms, 50 * us, 40 * us), nullptr, samples(100 * ms, 50 * us), period).cause,
              LateCause::machine_stopped);
    // Also inside a tick: no switch of threads, and no processor time.
    EXPECT_EQ(explain(tick(0, 5 * ms, 40 * us), nullptr, samples(100 * ms, 0), period).cause,
              LateCause::machine_stopped);
}

TEST(LateCause, IsComputingIfTheTickComputed) {
    EXPECT_EQ(explain(tick(0, 5 * ms, 4900 * us), nullptr, samples(100 * ms, 50 * us), period).cause,
              LateCause::compute);
}

TEST(LateCause, IsASleepInsideTheTickIfTheThreadGaveItsCoreAway) {
    EXPECT_EQ(explain(tick(0, 5 * ms, 40 * us), nullptr, samples(100 * ms, 0, true), period).cause, LateCause::blocked);
}

TEST(LateCause, OfATickAfterALongOneIsThatOfTheLongOne) {
    TickTrace before = tick(0, 5 * ms, 4900 * us);
    TickTrace next = before;
    ++next.tick;
    next.due += period;
    next.begun = before.done;
    next.done = next.begun + 50 * us;
    next.computed = 40 * us;
    next.missed = 4;
    EXPECT_EQ(explain(next, &before, samples(100 * ms, 0), period).cause, LateCause::compute);
    // Also if that one began late itself: its window starts where it began.
    before.due -= 30 * ms;
    before.missed = 30;
    before.longest = TickPart::change;
    const ExplainedTick found = explain(next, &before, samples(100 * ms, 0), period);
    EXPECT_EQ(found.cause, LateCause::compute);
    EXPECT_EQ(found.trace.longest, TickPart::change) << "the part of the long one";
    // Without the one before, nothing explains the wait.
    EXPECT_EQ(explain(next, nullptr, samples(100 * ms, 0), period).cause, LateCause::machine_stopped);
}

TEST(LateCause, OfATickThatComputedNeedsNoSamples) {
    EXPECT_EQ(explain(tick(0, 5 * ms, 4900 * us), nullptr, {}, period).cause, LateCause::compute);
}

TEST(LateCause, IsUnknownWithoutSamplesAroundTheTick) {
    EXPECT_EQ(explain(tick(5 * ms, 50 * us, 40 * us), nullptr, {}, period).cause, LateCause::unknown);
    std::vector<ThreadSample> early = samples(100 * ms, 5 * ms);
    early.resize(5);
    EXPECT_EQ(explain(tick(5 * ms, 50 * us, 40 * us), nullptr, early, period).cause, LateCause::unknown);
    // Two samples, 50 ms apart: the waiting may have been elsewhere.
    const std::vector<ThreadSample> all = samples(100 * ms, 5 * ms);
    const std::vector<ThreadSample> wide{all.front(), all.back()};
    EXPECT_EQ(explain(tick(5 * ms, 50 * us, 40 * us), nullptr, wide, period).cause, LateCause::unknown);
}

/// Returns the slowest of 100 ticks, of which the 50th does `work`.
ExplainedTick slowest_with(void (*work)()) {
    ThreadWatch watch(period);
    WallClock clock(1e-3, &watch);
    LateTicks late;
    std::thread([&] {
        watch.watch_this_thread();
        for (int i = 0; i < 100; ++i) {
            static_cast<void>(clock.wait());
            clock.parts().end_of(TickPart::motion);
            if (i == 50) work();
            clock.parts().end_of(TickPart::inputs);
            clock.tick_done();
        }
        late = watch.finish();
    }).join();
    EXPECT_EQ(std::accumulate(late.causes.begin(), late.causes.end(), std::uint64_t{0}), clock.times().late);
    EXPECT_FALSE(late.slowest.empty());
    return late.slowest.empty() ? ExplainedTick{} : late.slowest.front();
}

TEST(ThreadWatch, FindsATickThatComputes) {
    const ExplainedTick found = slowest_with([] {
        for (const std::clock_t begun = std::clock(); std::clock() - begun < CLOCKS_PER_SEC / 2;) {
        }
    });
    EXPECT_TRUE(found.trace.tick == 50 || found.trace.tick == 51) << found.trace.tick;
    EXPECT_NE(found.cause, LateCause::machine_stopped);
    EXPECT_NE(found.cause, LateCause::blocked);
    EXPECT_EQ(found.trace.longest, TickPart::inputs);
}

TEST(ThreadWatch, FindsATickThatSleeps) {
    const ExplainedTick found = slowest_with([] { std::this_thread::sleep_for(std::chrono::milliseconds(300)); });
    EXPECT_TRUE(found.trace.tick == 50 || found.trace.tick == 51) << found.trace.tick;
    EXPECT_EQ(found.cause, LateCause::blocked) << to_text(found.cause);
}

}  // namespace
}  // namespace kerf::run
