// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/law/call_times.h"

#include <algorithm>
#include <cmath>

#include "core/haptics/law/law_fault.h"
#include "core/plugin/number_text.h"

namespace kerf {

namespace {

std::string time_text(double seconds) {
    return seconds < 1e-3 ? number_text(1e6 * seconds, 3) + " us" : number_text(1e3 * seconds, 3) + " ms";
}

}  // namespace

double ClockScale::seconds_per_count() const noexcept {
    const double counts = static_cast<double>(clock_count() - start_);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_time_).count() /
           std::max(1.0, counts);
}

std::uint64_t CallTimes::end_of(std::size_t c) noexcept {
    if (c < parts) return c;
    const std::size_t power = c / parts + 3;
    return ((c % parts + parts + 1) << (power - 4)) - 1;
}

std::uint64_t CallTimes::longer_than(std::uint64_t counts) const noexcept {
    std::uint64_t sum = 0;
    for (std::size_t c = class_of(counts) + 1; c < classes_.size(); ++c) sum += classes_[c];
    return sum;
}

std::uint64_t CallTimes::within(double fraction) const noexcept {
    const double wanted = fraction * static_cast<double>(calls_);
    std::uint64_t sum = 0;
    for (std::size_t c = 0; c < classes_.size(); ++c) {
        sum += classes_[c];
        if (static_cast<double>(sum) >= wanted) return std::min(end_of(c), longest_);
    }
    return longest_;
}

std::string over_budget(const CallTimes& times, const kerf_component& law, const ClockScale& scale) {
    const double per_count = scale.seconds_per_count(), budget = 1e-9 * law.force->budget_ns;
    const std::uint64_t over = times.longer_than(static_cast<std::uint64_t>(budget / per_count));
    if (law.force->budget_ns == 0 || 100 * over <= times.calls()) return {};
    const auto in_time = [&](std::uint64_t counts) { return time_text(static_cast<double>(counts) * per_count); };
    return name_of_law(law) + ": " + std::to_string(over) + " of " + std::to_string(times.calls()) +
           " calls of `resist` took longer than its budget of " + time_text(budget) + ": 99.9 % within " +
           in_time(times.within(0.999)) + ", the longest " + in_time(times.longest()) +
           ". Make it faster, or declare the `budget_ns` that it needs.";
}

}  // namespace kerf
