// SPDX-License-Identifier: Apache-2.0
#include "run/clock/late_cause.h"

#include <algorithm>

namespace kerf::run {

namespace {

constexpr std::int64_t max_slack_periods = 4;  // by which samples may be wider than the tick

/// Returns the largest part of a time. `slept`: the thread gave its core away inside a tick.
LateCause largest(std::int64_t computed, std::int64_t waited, std::int64_t rest, bool slept) noexcept {
    if (computed >= waited && computed >= rest) return LateCause::compute;
    if (waited >= rest) return LateCause::core_taken;
    return slept ? LateCause::blocked : LateCause::machine_stopped;
}

}  // namespace

const char* to_text(LateCause cause) noexcept {
    switch (cause) {
        case LateCause::compute:
            return "own computing";
        case LateCause::core_taken:
            return "core taken by another thread";
        case LateCause::machine_stopped:
            return "machine stopped";
        case LateCause::blocked:
            return "thread blocked";
        case LateCause::unknown:
            break;
    }
    return "unknown";
}

ExplainedTick explain(const TickTrace& tick, const TickTrace* before, std::span<const ThreadSample> samples,
                      std::int64_t period) noexcept {
    ExplainedTick result{tick, LateCause::unknown, 0};
    if (before != nullptr && before->computed > tick.computed) {
        result.trace.longest = before->longest;
        result.trace.part_time = before->part_time;
    }
    const std::int64_t from = before != nullptr ? before->begun : tick.due;
    const std::int64_t computed = tick.computed + (before != nullptr ? before->computed : 0);
    const std::int64_t whole = tick.done - from;
    const auto after = std::partition_point(samples.begin(), samples.end(),
                                            [&](const ThreadSample& s) { return s.begun < tick.done; });
    const auto later =
        std::partition_point(samples.begin(), samples.end(), [&](const ThreadSample& s) { return s.at <= from; });
    const bool has_samples = after != samples.end() && later != samples.begin();
    if (has_samples) result.faults = after->faults - (later - 1)->faults;
    if (2 * computed >= whole) result.cause = LateCause::compute;
    if (!has_samples || result.cause == LateCause::compute) return result;

    const ThreadSample &first = *(later - 1), &last = *after;
    const std::int64_t waited = std::min(last.waited - first.waited, whole);
    const std::int64_t slack = (last.at - first.begun) - whole;
    if (slack > max_slack_periods * period && waited > whole / 10) return result;
    const std::int64_t begun = before != nullptr ? before->begun : tick.begun;
    const bool slept = std::any_of(
        later, after, [&](const ThreadSample& s) { return s.is_blocked && s.begun > begun && s.at < tick.done; });
    result.cause = largest(computed, waited, std::max<std::int64_t>(whole - computed - waited, 0), slept);
    return result;
}

}  // namespace kerf::run
