// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/abi.h"

/// Quantities with their units: literals, and the units in which parameters are displayed.
namespace kerf {

inline constexpr double pi = 3.14159265358979323846;

namespace dimension {
inline constexpr kerf_dimension none{{0, 0, 0, 0, 0, 0, 0, 0}};
inline constexpr kerf_dimension length{{1, 0, 0, 0, 0, 0, 0, 0}};
inline constexpr kerf_dimension angle{{0, 0, 0, 0, 0, 0, 0, 1}};
inline constexpr kerf_dimension time{{0, 0, 1, 0, 0, 0, 0, 0}};
inline constexpr kerf_dimension mass{{0, 1, 0, 0, 0, 0, 0, 0}};
inline constexpr kerf_dimension speed{{1, 0, -1, 0, 0, 0, 0, 0}};
inline constexpr kerf_dimension frequency{{0, 0, -1, 0, 0, 0, 0, 0}};  ///< revolutions or strokes per second
inline constexpr kerf_dimension turn_speed{{0, 0, -1, 0, 0, 0, 0, 1}};
inline constexpr kerf_dimension force{{1, 1, -2, 0, 0, 0, 0, 0}};
inline constexpr kerf_dimension torque{{2, 1, -2, 0, 0, 0, 0, 0}};
inline constexpr kerf_dimension force_per_length{{0, 1, -2, 0, 0, 0, 0, 0}};
inline constexpr kerf_dimension pressure{{-1, 1, -2, 0, 0, 0, 0, 0}};
inline constexpr kerf_dimension density{{-3, 1, 0, 0, 0, 0, 0, 0}};
inline constexpr kerf_dimension volume{{3, 0, 0, 0, 0, 0, 0, 0}};
inline constexpr kerf_dimension power{{2, 1, -3, 0, 0, 0, 0, 0}};
inline constexpr kerf_dimension inertia{{2, 1, 0, 0, 0, 0, 0, 0}};  ///< moment of inertia
inline constexpr kerf_dimension energy{{2, 1, -2, 0, 0, 0, 0, 0}};
inline constexpr kerf_dimension damping{{0, 1, -1, 0, 0, 0, 0, 0}};
inline constexpr kerf_dimension angular_stiffness{{2, 1, -2, 0, 0, 0, 0, -1}};
}  // namespace dimension

constexpr bool operator==(const kerf_dimension& a, const kerf_dimension& b) noexcept {
    for (int i = 0; i < 8; ++i)
        if (a.exponent[i] != b.exponent[i]) return false;
    return true;
}

/// A number in SI with its dimension: `3.2_mm`. It converts to the number.
struct Quantity {
    double si;
    kerf_dimension dimension;

    constexpr operator double() const noexcept { return si; }
};
constexpr Quantity operator-(Quantity q) noexcept { return {-q.si, q.dimension}; }

/// Literals in the units that a surgeon uses; the value is in SI.
inline namespace literals {
#define KERF_LITERAL(suffix, factor, dim)                                  \
    constexpr Quantity operator""##suffix(long double v) noexcept {        \
        return {static_cast<double>(v) * (factor), dimension::dim};        \
    }                                                                      \
    constexpr Quantity operator""##suffix(unsigned long long v) noexcept { \
        return {static_cast<double>(v) * (factor), dimension::dim};        \
    }
KERF_LITERAL(_m, 1.0, length)
KERF_LITERAL(_mm, 1e-3, length)
KERF_LITERAL(_um, 1e-6, length)
KERF_LITERAL(_s, 1.0, time)
KERF_LITERAL(_ms, 1e-3, time)
KERF_LITERAL(_deg, 3.14159265358979323846 / 180.0, angle)
KERF_LITERAL(_turns, 2.0 * 3.14159265358979323846, angle)
KERF_LITERAL(_kg, 1.0, mass)
KERF_LITERAL(_N, 1.0, force)
KERF_LITERAL(_N_per_mm, 1e3, force_per_length)
KERF_LITERAL(_N_per_mm2, 1e6, pressure)
KERF_LITERAL(_Nmm, 1e-3, torque)
KERF_LITERAL(_mm_per_s, 1e-3, speed)
KERF_LITERAL(_rpm, 1.0 / 60.0, frequency)  // revolutions or strokes per second
KERF_LITERAL(_g_per_cm3, 1e3, density)
KERF_LITERAL(_kg_m2, 1.0, inertia)
KERF_LITERAL(_W, 1.0, power)
#undef KERF_LITERAL
}  // namespace literals

/// The unit in which a value is displayed, and its dimension.
struct DisplayUnit {
    const char* name;
    kerf_dimension dimension;
};
namespace unit {
inline constexpr DisplayUnit none{"", dimension::none};
inline constexpr DisplayUnit mm{"mm", dimension::length};
inline constexpr DisplayUnit um{"um", dimension::length};
inline constexpr DisplayUnit deg{"deg", dimension::angle};
inline constexpr DisplayUnit s{"s", dimension::time};
inline constexpr DisplayUnit ms{"ms", dimension::time};
inline constexpr DisplayUnit kg{"kg", dimension::mass};
inline constexpr DisplayUnit mm_per_s{"mm/s", dimension::speed};
inline constexpr DisplayUnit rpm{"rpm", dimension::frequency};
inline constexpr DisplayUnit per_min{"1/min", dimension::frequency};
inline constexpr DisplayUnit N{"N", dimension::force};
inline constexpr DisplayUnit N_m{"N m", dimension::torque};
inline constexpr DisplayUnit N_mm{"N mm", dimension::torque};
inline constexpr DisplayUnit N_per_mm{"N/mm", dimension::force_per_length};
inline constexpr DisplayUnit N_per_mm2{"N/mm2", dimension::pressure};
inline constexpr DisplayUnit g_per_cm3{"g/cm3", dimension::density};
inline constexpr DisplayUnit mm3{"mm3", dimension::volume};
inline constexpr DisplayUnit W{"W", dimension::power};
inline constexpr DisplayUnit kg_mm2{"kg mm2", dimension::inertia};
}  // namespace unit

}  // namespace kerf
