// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace kerf {

/// Returns the distance [m] by which linear interpolation between samples `h` [m] apart may displace a round wall of
/// `radius` [m] inwards:
///
///     h²/(8 r),   r the radius of the innermost samples: 0.7 h less than `radius`, at least h/2
///
/// [any] pure.
[[nodiscard]] constexpr double wall_sagitta(double radius, double h) noexcept {
    return h * h / (8.0 * std::max(radius - 0.7 * h, 0.5 * h));
}

}  // namespace kerf
