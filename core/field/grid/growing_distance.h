// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace kerf {

/// Lets distances on a lattice grow from where they are fixed, as |∇d| = 1 has it, first order, upwind: fast sweeping
/// (Zhao 2005, eqs. 2.3–2.4). First order: around an edge it makes them a little too large.
///
/// `size` points along each axis, x fastest, `spacing` [m] apart; where it is not fixed, `distance` [m] is HUGE_VAL
/// before. From what has come to `farthest` [m] nothing grows on.   [main, worker]
void grow_distances(const std::array<int, 3>& size, const std::array<double, 3>& spacing,
                    const std::vector<std::uint8_t>& is_fixed, double farthest, std::vector<double>& distance);

}  // namespace kerf
