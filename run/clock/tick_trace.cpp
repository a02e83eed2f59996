// SPDX-License-Identifier: Apache-2.0
#include "run/clock/tick_trace.h"

#include <algorithm>
#include <ctime>

namespace kerf::run {

namespace {
std::int64_t time_of(clockid_t clock) noexcept {
    timespec time{};
    clock_gettime(clock, &time);
    return time.tv_sec * std::int64_t{1'000'000'000} + time.tv_nsec;
}
}  // namespace

std::int64_t monotonic_time() noexcept { return time_of(CLOCK_MONOTONIC); }
std::int64_t thread_time() noexcept { return time_of(CLOCK_THREAD_CPUTIME_ID); }

const char* to_text(TickPart part) noexcept {
    switch (part) {
        case TickPart::change:
            return "change of tool or bodies";
        case TickPart::inputs:
            return "inputs of the hand";
        case TickPart::hand:
            return "hand or device";
        case TickPart::motion:
            return "motion and force";
    }
    return "";
}

TickPart TickParts::longest() const noexcept {
    return static_cast<TickPart>(std::max_element(times_.begin(), times_.end()) - times_.begin());
}

}  // namespace kerf::run
