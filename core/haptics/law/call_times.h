// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

#include "kerf/abi.h"

#if defined(__x86_64__)
#include <x86intrin.h>
#endif

/// Measures how long a law's calls take. The times never enter a result, a record or a hash.
namespace kerf {

/// Returns a counter that increases at a constant rate. On x86-64 this is the processor's own counter, so the tick
/// makes no system call. [any] nonblocking
[[nodiscard]] inline std::uint64_t clock_count() noexcept {
#if defined(__x86_64__)
    return __rdtsc();
#else
    return static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
#endif
}

/// Measures the duration of one count of `clock_count`: the time since the construction, divided by the counts since
/// then.
class ClockScale {
public:
    ClockScale() noexcept : start_(clock_count()), start_time_(std::chrono::steady_clock::now()) {}
    [[nodiscard]] double seconds_per_count() const noexcept;  // [any]

private:
    std::uint64_t start_;
    std::chrono::steady_clock::time_point start_time_;
};

/// Histogram of the durations of calls, in counts of `clock_count`. A class is at most 1/16 of its duration wide, or
/// one count.
class CallTimes {
public:
    /// [haptic, nonblocking]
    void add(std::uint64_t counts) noexcept {
        ++calls_;
        longest_ = counts > longest_ ? counts : longest_;
        ++classes_[class_of(counts)];
    }
    [[nodiscard]] std::uint64_t calls() const noexcept { return calls_; }
    [[nodiscard]] std::uint64_t longest() const noexcept { return longest_; }
    /// Returns the number of calls in the classes above that of `counts`.   [any]
    [[nodiscard]] std::uint64_t longer_than(std::uint64_t counts) const noexcept;
    /// Returns a duration that at least `fraction` (0 … 1) of the calls do not exceed: the upper end of a class, or the
    /// longest call if that is shorter [counts].   [any]
    [[nodiscard]] std::uint64_t within(double fraction) const noexcept;

private:
    static constexpr int parts = 16;  ///< number of classes from each power of two to the next

    [[nodiscard]] static std::size_t class_of(std::uint64_t counts) noexcept {
        if (counts < parts) return static_cast<std::size_t>(counts);
        const auto power = static_cast<int>(std::bit_width(counts)) - 1;
        return static_cast<std::size_t>((power - 3) * parts) + (counts >> (power - 4)) - parts;
    }
    [[nodiscard]] static std::uint64_t end_of(std::size_t c) noexcept;

    std::uint64_t calls_ = 0, longest_ = 0;
    std::array<std::uint32_t, 62 * parts> classes_{};
};

/// Returns one line of text if more than 1 % of this law's `resist` calls took longer than the budget that it declares.
/// Else, or if it declares none, returns an empty text. Fewer overruns are normal, because the operating system can
/// interrupt any call.   [main]
[[nodiscard]] std::string over_budget(const CallTimes& times, const kerf_component& law, const ClockScale& scale);

}  // namespace kerf
