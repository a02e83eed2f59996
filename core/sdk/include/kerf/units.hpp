// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/abi.h"

/// Literals in the units a surgeon thinks in, converted to SI by the literal.
namespace kerf {

inline constexpr double pi = 3.14159265358979323846;

namespace literals {
#define KERF_LITERAL(suffix, factor)                                                                          \
    constexpr double operator""##suffix(long double v) noexcept { return static_cast<double>(v) * (factor); } \
    constexpr double operator""##suffix(unsigned long long v) noexcept { return static_cast<double>(v) * (factor); }
KERF_LITERAL(_m, 1.0)
KERF_LITERAL(_mm, 1e-3)
KERF_LITERAL(_um, 1e-6)
KERF_LITERAL(_s, 1.0)
KERF_LITERAL(_ms, 1e-3)
KERF_LITERAL(_deg, 3.14159265358979323846 / 180.0)
KERF_LITERAL(_kg, 1.0)
KERF_LITERAL(_N, 1.0)
KERF_LITERAL(_N_per_mm, 1e3)
KERF_LITERAL(_N_per_mm2, 1e6)
KERF_LITERAL(_Nmm, 1e-3)
KERF_LITERAL(_mm_per_s, 1e-3)
KERF_LITERAL(_rpm, 1.0 / 60.0)  // revolutions per second
KERF_LITERAL(_g_per_cm3, 1e3)
#undef KERF_LITERAL
}  // namespace literals

namespace dimension {
inline constexpr kerf_dimension none{{0, 0, 0, 0, 0, 0, 0, 0}};
inline constexpr kerf_dimension length{{1, 0, 0, 0, 0, 0, 0, 0}};
inline constexpr kerf_dimension angle{{0, 0, 0, 0, 0, 0, 0, 1}};
inline constexpr kerf_dimension time{{0, 0, 1, 0, 0, 0, 0, 0}};
inline constexpr kerf_dimension mass{{0, 1, 0, 0, 0, 0, 0, 0}};
inline constexpr kerf_dimension speed{{1, 0, -1, 0, 0, 0, 0, 0}};
inline constexpr kerf_dimension frequency{{0, 0, -1, 0, 0, 0, 0, 0}};  ///< revolutions or strokes per second
inline constexpr kerf_dimension force{{1, 1, -2, 0, 0, 0, 0, 0}};
inline constexpr kerf_dimension torque{{2, 1, -2, 0, 0, 0, 0, 0}};
inline constexpr kerf_dimension force_per_length{{0, 1, -2, 0, 0, 0, 0, 0}};
inline constexpr kerf_dimension pressure{{-1, 1, -2, 0, 0, 0, 0, 0}};
inline constexpr kerf_dimension density{{-3, 1, 0, 0, 0, 0, 0, 0}};
inline constexpr kerf_dimension volume{{3, 0, 0, 0, 0, 0, 0, 0}};
}  // namespace dimension

constexpr bool operator==(const kerf_dimension& a, const kerf_dimension& b) noexcept {
    for (int i = 0; i < 8; ++i)
        if (a.exponent[i] != b.exponent[i]) return false;
    return true;
}

}  // namespace kerf
