// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace kerf {

/// How far inside the true one a round wall of `radius` may lie, known by samples `h` apart and straight between them
/// [m]:
///
///     h²/(8 r),   r where the innermost samples are, 0.7 h further in; half a voxel at least
///
/// [any] pure.
[[nodiscard]] constexpr double wall_sagitta(double radius, double h) noexcept {
    return h * h / (8.0 * std::max(radius - 0.7 * h, 0.5 * h));
}

}  // namespace kerf
