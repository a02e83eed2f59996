// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#if defined(__x86_64__)
#include <x86intrin.h>
#endif

namespace kerf {

/// The control words of the calling thread's floating-point units: rounding, traps, numbers near zero. Not the flags
/// that operations set. On other machines than x86-64 there is none.
struct FloatingPoint {
    std::uint32_t sse = 0;
    std::uint16_t x87 = 0;
    bool operator==(const FloatingPoint&) const = default;
};

/// Returns the present control words.   [any] nonblocking
[[nodiscard]] inline FloatingPoint floating_point() noexcept {
    FloatingPoint now;
#if defined(__x86_64__)
    constexpr std::uint32_t flags = 0x3f;
    now.sse = _mm_getcsr() & ~flags;
    __asm__ volatile("fnstcw %0" : "=m"(now.x87));
#endif
    return now;
}

/// Sets the control words, and clears the flags of operations.   [any] nonblocking
inline void set_floating_point([[maybe_unused]] const FloatingPoint& wanted) noexcept {
#if defined(__x86_64__)
    __asm__ volatile("fnclex\n\tfldcw %0" : : "m"(wanted.x87));
    _mm_setcsr(wanted.sse);
#endif
}

}  // namespace kerf
