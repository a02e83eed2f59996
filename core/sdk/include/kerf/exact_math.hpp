// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "kerf/units.hpp"

/// exp, sin and cos with the same bits on every machine: they use only +, −, × and ÷. In the ranges below they are
/// within 2 ulp of the library's functions. The tick uses these alone.
namespace kerf {

namespace detail {
/// Returns 2^k for −1022 ≤ k ≤ 1023.
constexpr double power_of_two(int k) noexcept {
    return std::bit_cast<double>(static_cast<std::uint64_t>(k + 1023) << 52);
}

/// Returns (±1)ⁱ / (first + step i)! for i < count.
template <std::size_t count>
constexpr std::array<double, count> one_over_factorials(int first, int step, double sign) noexcept {
    std::array<double, count> c{};
    double factorial = 1.0, factor = 1.0;
    for (int n = 1, i = 0; i < static_cast<int>(count); ++n) {
        factorial *= n;
        if (n != first + step * i) continue;
        c[static_cast<std::size_t>(i++)] = factor / factorial;
        factor *= sign;
    }
    return c;
}

/// Returns Σ cᵢ xⁱ. It adds pairs, pairs of pairs and so on, which keeps chains of dependent sums short. `power` is x,
/// x², x⁴, x⁸.
template <std::size_t first, std::size_t count, std::size_t all>
constexpr double polynomial(const std::array<double, all>& c, const double (&power)[4]) noexcept {
    if constexpr (count == 1) {
        return c[first];
    } else {
        constexpr std::size_t half = std::bit_floor(count - 1);
        return polynomial<first, half>(c, power) +
               polynomial<first + half, count - half>(c, power) * power[std::countr_zero(half)];
    }
}
template <std::size_t all>
constexpr double polynomial(const std::array<double, all>& c, double x) noexcept {
    const double x2 = x * x, x4 = x2 * x2, power[4] = {x, x2, x4, x4 * x4};
    return polynomial<0, all>(c, power);
}
}  // namespace detail

/// Returns e^x; 0 for x ≤ −708, the largest double for x > 709.   [any] pure, nonblocking.
constexpr double exp_exact(double x) noexcept {
    if (!(x > -708.0)) return 0.0;
    if (x > 709.0) return 1.7976931348623157e308;
    constexpr double ln2_high = 6.93147180369123816490e-01, ln2_low = 1.90821492927058770002e-10;
    const double scaled = x * 1.44269504088896338700;
    const int k = static_cast<int>(scaled + (scaled >= 0.0 ? 0.5 : -0.5));
    const double r = (x - k * ln2_high) - k * ln2_low;  // |r| ≤ ln 2 / 2
    constexpr auto c = detail::one_over_factorials<13>(2, 1, 1.0);
    return (1.0 + (r + r * r * detail::polynomial(c, r))) * detail::power_of_two(k);
}

struct SinCos {
    double sin, cos;
};

/// Returns sine and cosine of `x` [rad], |x| ≤ 1e6.   [any] pure, nonblocking.
constexpr SinCos sin_cos_exact(double x) noexcept {
    const double turns = x / (0.5 * pi);
    const auto quarter = static_cast<std::int64_t>(turns + (turns >= 0.0 ? 0.5 : -0.5));
    constexpr double half_pi_high = 1.57079632673412561417e+00, half_pi_low = 6.07710050650619224932e-11;
    const double q = static_cast<double>(quarter);
    const double r = (x - q * half_pi_high) - q * half_pi_low;  // |r| ≤ π/4
    const double r2 = r * r;
    constexpr auto of_sine = detail::one_over_factorials<9>(3, 2, -1.0),
                   of_cosine = detail::one_over_factorials<9>(2, 2, -1.0);
    const double s = r - r * r2 * detail::polynomial(of_sine, r2);
    const double c = 1.0 - r2 * detail::polynomial(of_cosine, r2);
    switch (static_cast<int>(((quarter % 4) + 4) % 4)) {
        case 0:
            return {s, c};
        case 1:
            return {c, -s};
        case 2:
            return {-s, -c};
        default:
            return {-c, s};
    }
}

}  // namespace kerf
