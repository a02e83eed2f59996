// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace kerf {

/// Extends distances on a lattice from fixed points by |∇d| = 1, with first-order upwind differences: fast sweeping
/// (Zhao 2005, eqs. 2.3–2.4). Being first order, it makes distances around an edge slightly too large.
///
/// `size` points along each axis, x fastest, `spacing` [m] apart. Where `distance` [m] is not fixed, it is HUGE_VAL at
/// the start. Distances of `farthest` [m] and more are not extended.   [main, worker]
void grow_distances(const std::array<int, 3>& size, const std::array<double, 3>& spacing,
                    const std::vector<std::uint8_t>& is_fixed, double farthest, std::vector<double>& distance);

}  // namespace kerf
