// SPDX-License-Identifier: Apache-2.0
#include "run/clock/wall_clock.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <ctime>

#include "core/haptics/loop/hand_motion.h"

namespace kerf::run {

namespace {

constexpr std::int64_t second = 1'000'000'000;  // [ns]
constexpr std::int64_t spin = 150'000;          // [ns] at the end of a wait; a wake-up of a busy core is that late

void sleep_until(std::int64_t due) noexcept {
    const timespec time{due / second, due % second};
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr) == EINTR) {
    }
}

}  // namespace

WallClock::WallClock(double period, ThreadWatch* watch) noexcept
    : period_(std::llround(period * static_cast<double>(second))), watch_(watch) {}

std::uint32_t WallClock::wait() noexcept {
    std::int64_t now = monotonic_time();
    due_ = due_ == 0 ? now + period_ : due_ + period_;
    if (watch_ != nullptr) watch_->report_sleep(true);
    sleep_until(std::max(due_ - spin, now + 1));
    if (watch_ != nullptr) watch_->report_sleep(false);
    while ((now = monotonic_time()) < due_) {
    }
    const std::int64_t lateness = now - due_;
    trace_.tick = times_.ticks;
    trace_.due = due_;
    trace_.begun = now;
    const std::int64_t missed = lateness / period_;
    due_ += missed * period_;

    ++times_.ticks;
    times_.lateness.add(static_cast<std::uint64_t>(lateness));
    if (missed > 0) ++times_.late;
    times_.missed += static_cast<std::uint64_t>(missed);
    const auto count = static_cast<std::uint32_t>(std::min<std::int64_t>(missed, UINT32_MAX));
    if (count >= HandMotion::missed_ticks_of_pause) ++times_.pauses;
    trace_.missed = count;
    begun_cpu_ = thread_time();
    parts_.begin();
    return count;
}

void WallClock::tick_done() noexcept {
    const std::int64_t computed = thread_time() - begun_cpu_;
    times_.compute.add(static_cast<std::uint64_t>(computed));
    if (computed > period_) ++times_.over_period;
    if (watch_ == nullptr) return;
    trace_.done = monotonic_time();
    trace_.computed = computed;
    trace_.longest = parts_.longest();
    trace_.part_time = parts_.time_of(trace_.longest);
    watch_->report(trace_);
}

}  // namespace kerf::run
