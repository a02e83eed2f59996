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

/// Measures the duration of one count, from the counts and the time since its construction.
class ClockScale {
public:
    ClockScale() noexcept : start_(clock_count()), start_time_(std::chrono::steady_clock::now()) {}
    [[nodiscard]] double seconds_per_count() const noexcept;  // [any]

private:
    std::uint64_t start_;
    std::chrono::steady_clock::time_point start_time_;
};

/// Histogram of durations. A class is at most 1/16 of its duration wide, or one count.
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
    /// Returns the number of calls longer than `counts`, without those in the same class.   [any]
    [[nodiscard]] std::uint64_t longer_than(std::uint64_t counts) const noexcept;
    /// Returns the upper end of the class below which `fraction` of the calls lie.   [any]
    [[nodiscard]] std::uint64_t within(double fraction) const noexcept;

private:
    static constexpr int parts = 16;  ///< classes of each power of two

    [[nodiscard]] static std::size_t class_of(std::uint64_t counts) noexcept {
        if (counts < parts) return static_cast<std::size_t>(counts);
        const auto power = static_cast<int>(std::bit_width(counts)) - 1;
        return static_cast<std::size_t>((power - 3) * parts) + (counts >> (power - 4)) - parts;
    }
    [[nodiscard]] static std::uint64_t end_of(std::size_t c) noexcept;

    std::uint64_t calls_ = 0, longest_ = 0;
    std::array<std::uint32_t, 62 * parts> classes_{};
};

/// Returns one line if more than 1 % of this law's `resist` calls took longer than the declared budget, else an empty
/// text. Fewer overruns are normal, because the operating system can interrupt any call.   [main]
[[nodiscard]] std::string over_budget(const CallTimes& times, const kerf_component& law, const ClockScale& scale);

}  // namespace kerf
