// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/field/grid.h"
#include "core/field/region.h"
#include "core/procedure/anatomy.h"
#include "core/procedure/solids.h"

/// How much of a real bone a scene needs: the surroundings of the planned axes. Frame: LPS, metres.
namespace kerf {

/// The box 15 mm around the axes; from +∞ to −∞ when there are none.   [any] pure.
[[nodiscard]] Box box_around(const std::vector<LandmarkAxis>& axes) noexcept;

/// What lies in both; a box without inside when they miss each other.
[[nodiscard]] Box common_part(const Box& a, const Box& b) noexcept;
[[nodiscard]] bool is_empty(const Box& box) noexcept;

/// The box and `margin` [m] more on every side.
[[nodiscard]] Box grown(const Box& box, double margin) noexcept;

/// The largest region in the box whose faces lie on samples of the grid.
[[nodiscard]] Region region_on(const Grid& grid, const Box& box);

}  // namespace kerf
