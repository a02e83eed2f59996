// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>

#include "kerf/units.hpp"

/// exp, sin and cos with the same bits on every machine: only +, −, ×, ÷, written out. Within 2 ulp of the library's
/// in the ranges stated; the tick uses these and no others.
namespace kerf {

namespace detail {
/// 2^k for −1022 ≤ k ≤ 1023.
constexpr double power_of_two(int k) noexcept {
    return std::bit_cast<double>(static_cast<std::uint64_t>(k + 1023) << 52);
}
}  // namespace detail

/// e^x; 0 below −708, +largest above 709.   [any] pure, nonblocking.
constexpr double exp_exact(double x) noexcept {
    if (!(x > -708.0)) return 0.0;
    if (x > 709.0) return 1.7976931348623157e308;
    constexpr double ln2_high = 6.93147180369123816490e-01, ln2_low = 1.90821492927058770002e-10;
    const double scaled = x * 1.44269504088896338700;
    const int k = static_cast<int>(scaled + (scaled >= 0.0 ? 0.5 : -0.5));
    const double r = (x - k * ln2_high) - k * ln2_low;  // |r| ≤ ln 2 / 2
    constexpr double inverse[] = {0.0,     1.0,     1.0 / 2, 1.0 / 3,  1.0 / 4,  1.0 / 5,  1.0 / 6, 1.0 / 7,
                                  1.0 / 8, 1.0 / 9, 1.0 / 10, 1.0 / 11, 1.0 / 12, 1.0 / 13, 1.0 / 14};
    double sum = 1.0;
    for (int n = 14; n >= 1; --n) sum = 1.0 + r * inverse[n] * sum;
    return sum * detail::power_of_two(k);
}

struct SinCos {
    double sin, cos;
};

/// sin and cos of `x` [rad], |x| ≤ 1e6.   [any] pure, nonblocking.
constexpr SinCos sin_cos_exact(double x) noexcept {
    const double turns = x / (0.5 * pi);
    const auto quarter = static_cast<std::int64_t>(turns + (turns >= 0.0 ? 0.5 : -0.5));
    constexpr double half_pi_high = 1.57079632673412561417e+00, half_pi_low = 6.07710050650619224932e-11;
    const double q = static_cast<double>(quarter);
    const double r = (x - q * half_pi_high) - q * half_pi_low;  // |r| ≤ π/4
    const double r2 = r * r;
    double s = 1.0, c = 1.0;
    for (int n = 9; n >= 1; --n) {
        s = 1.0 - r2 / ((2 * n) * (2 * n + 1)) * s;
        c = 1.0 - r2 / ((2 * n - 1) * (2 * n)) * c;
    }
    s *= r;
    switch (static_cast<int>(((quarter % 4) + 4) % 4)) {
        case 0: return {s, c};
        case 1: return {c, -s};
        case 2: return {-s, -c};
        default: return {-c, s};
    }
}

}  // namespace kerf
