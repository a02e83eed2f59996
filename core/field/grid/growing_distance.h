// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace kerf {

/// Computes distances on a lattice from the distances at fixed points. Solves |∇d| = 1 by fast sweeping (Zhao 2005,
/// eqs. 2.3–2.4). The differences are upwind and of first order, so distances around an edge become slightly too large.
///
/// `size` points along each axis, x fastest, `spacing` [m] apart. Where `distance` [m] is not fixed, it must be
/// HUGE_VAL at the start. A point whose neighbours all have `farthest` [m] or more keeps its value.   [main, worker]
void grow_distances(const std::array<int, 3>& size, const std::array<double, 3>& spacing,
                    const std::vector<std::uint8_t>& is_fixed, double farthest, std::vector<double>& distance);

}  // namespace kerf
