// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "documents/anatomy.h"
#include "documents/made/measured_dimension.h"

namespace kerf::documents {

/// Returns the dimensions of the upper end of a femur, measured by straight lines through its bone [SI]. It uses the
/// landmarks `head`, `neck` and `shaft`; without them the result is empty.   [main]
/// Pre: a left femur in patient axes, the neck in the plane y = 0, the shaft along z.
[[nodiscard]] std::vector<MeasuredDimension> measured_proximal_femur(const Anatomy& anatomy);

}  // namespace kerf::documents
