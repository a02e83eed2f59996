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

/// How long a law's calls take. Measured beside the tick: nothing of it enters a result, a record or a hash.
namespace kerf {

/// A count that grows evenly with time. On x86-64 the processor's own, so that the tick makes no call for it.
/// [any] nonblocking
[[nodiscard]] inline std::uint64_t clock_count() noexcept {
#if defined(__x86_64__)
    return __rdtsc();
#else
    return static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
#endif
}

/// Finds how long one count lasts, by the time since it was made.
class ClockScale {
public:
    ClockScale() noexcept : start_(clock_count()), start_time_(std::chrono::steady_clock::now()) {}
    [[nodiscard]] double seconds_per_count() const noexcept;  // [any]

private:
    std::uint64_t start_;
    std::chrono::steady_clock::time_point start_time_;
};

/// Durations, sorted into classes 6 % wide.
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
    /// How many took longer, but for those of the same class.   [any]
    [[nodiscard]] std::uint64_t longer_than(std::uint64_t counts) const noexcept;
    /// The upper end of the class within which `fraction` of the calls end.   [any]
    [[nodiscard]] std::uint64_t within(double fraction) const noexcept;

private:
    static constexpr int parts = 16;  ///< of each power of two

    [[nodiscard]] static std::size_t class_of(std::uint64_t counts) noexcept {
        if (counts < parts) return static_cast<std::size_t>(counts);
        const auto power = static_cast<int>(std::bit_width(counts)) - 1;
        return static_cast<std::size_t>((power - 3) * parts) + (counts >> (power - 4)) - parts;
    }
    [[nodiscard]] static std::uint64_t end_of(std::size_t c) noexcept;

    std::uint64_t calls_ = 0, longest_ = 0;
    std::array<std::uint32_t, 62 * parts> classes_{};
};

/// One line, where more than one call in a hundred of this law's `resist` took longer than its declared budget; else
/// empty. Rarer ones are the system's, which interrupts any call.   [main]
[[nodiscard]] std::string over_budget(const CallTimes& times, const kerf_component& law, const ClockScale& scale);

}  // namespace kerf
