// SPDX-License-Identifier: Apache-2.0
#include "run/clock/clock_row.h"

#include <sys/utsname.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>

namespace kerf::run {

namespace {

constexpr double seconds_of(std::int64_t nanoseconds) { return 1e-9 * static_cast<double>(nanoseconds); }

session::ClockRow::Times times_of(const CallTimes& times) {
    const auto at = [&](double fraction) { return seconds_of(static_cast<std::int64_t>(times.within(fraction))); };
    return {at(0.5), at(0.99), at(0.999), seconds_of(static_cast<std::int64_t>(times.longest()))};
}

/// Returns classes of 1, 2 and 5 times a power of ten, from 1 us to 1 s; the last has no upper end and ends at the
/// longest time.
std::vector<session::ClockRow::Class> histogram_of(const TickTimes& times) {
    std::vector<session::ClockRow::Class> classes;
    std::uint64_t lateness = 0, compute = 0;  // ticks in the classes so far
    const auto add = [&](double up_to, std::uint64_t late, std::uint64_t computed) {
        classes.push_back({up_to, late - lateness, computed - compute});
        lateness = late;
        compute = computed;
    };
    for (std::uint64_t decade = 1000; decade <= 1'000'000'000; decade *= 10)
        for (const std::uint64_t step : {1, 2, 5}) {
            const std::uint64_t bound = decade * step;
            if (bound > 1'000'000'000) break;
            add(seconds_of(static_cast<std::int64_t>(bound)),
                times.lateness.calls() - times.lateness.longer_than(bound),
                times.compute.calls() - times.compute.longer_than(bound));
        }
    const std::uint64_t longest = std::max(times.lateness.longest(), times.compute.longest());
    if (longest > 1'000'000'000)
        add(seconds_of(static_cast<std::int64_t>(longest)), times.lateness.calls(), times.compute.calls());
    return classes;
}

session::ClockRow::SlowTick row_of(const ExplainedTick& tick) {
    const TickTrace& trace = tick.trace;
    return {.tick = trace.tick,
            .lateness = seconds_of(trace.begun - trace.due),
            .response = seconds_of(trace.response()),
            .compute = seconds_of(trace.computed),
            .cause = to_text(tick.cause),
            .part = to_text(trace.longest),
            .part_time = seconds_of(trace.part_time),
            .page_faults = tick.faults};
}

}  // namespace

session::ClockRow clock_row(double period, const TickTimes& times, const LateTicks& late, const RealtimeState& state) {
    session::ClockRow row;
    row.period = period;
    row.ticks = times.ticks;
    row.late_ticks = times.late;
    row.missed_periods = times.missed;
    row.pauses = times.pauses;
    row.over_period = times.over_period;
    row.lateness = times_of(times.lateness);
    row.compute = times_of(times.compute);
    row.histogram = histogram_of(times);
    for (std::size_t cause = 0; cause < late_cause_count; ++cause)
        row.late_causes.emplace_back(to_text(static_cast<LateCause>(cause)), late.causes[cause]);
    for (const ExplainedTick& tick : late.slowest) row.slowest.push_back(row_of(tick));
    row.priority = state.priority;
    row.is_memory_locked = state.is_locked;
    row.refusals = state.refusals;
    double load = 0.0;
    if (getloadavg(&load, 1) == 1) row.load = load;
    if (utsname system{}; uname(&system) == 0) row.kernel = system.release;
    return row;
}

}  // namespace kerf::run
