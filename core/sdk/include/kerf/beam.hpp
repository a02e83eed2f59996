// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Stiffness of tools that bend: beams, alone and in series with the bone that they touch. All SI.
namespace kerf {

inline constexpr double stainless_steel = 193e9;  ///< Young's modulus [Pa]

/// Returns the stiffness [N/m] of a beam that is clamped at one end and loaded across at the other.
///
///     k = 3 E I / l³
///
/// @param second_moment  I of its section [m⁴]
/// @param cubed_length   l³ [m³]; for a beam of several sections the sum of their parts, each weighted with I/I_i
/// [any] pure.
[[nodiscard]] constexpr double cantilever_stiffness(double modulus, double second_moment,
                                                    double cubed_length) noexcept {
    return 3.0 * modulus * second_moment / cubed_length;
}

/// Returns the stiffness [N/m] of two springs in series, such as a beam and the bone at its end.   [any] pure.
[[nodiscard]] constexpr double in_series(double first, double second) noexcept {
    return first * second / (first + second);
}

}  // namespace kerf
