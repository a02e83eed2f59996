// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/field/grid/box.h"
#include "documents/anatomy.h"

namespace kerf::bone {

/// Returns the part of a bone that a procedure can touch: the box around the planned axes and 15 mm more on every side,
/// clipped to `available`. Empty (`low` not below `high`) if the axes lie outside it, or there are none.   [any] pure.
[[nodiscard]] Box planned_region(const std::vector<documents::LandmarkAxis>& axes, const Box& available);

[[nodiscard]] bool is_empty(const Box& box) noexcept;

}  // namespace kerf::bone
