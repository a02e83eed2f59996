// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "documents/anatomy.h"
#include "documents/made/measured_dimension.h"

namespace kerf::documents {

/// Returns the dimensions of a lower jaw, measured by straight lines through its bone [SI]. It uses the landmarks
/// `gonion_right`, `condylion_right` and `menton`, the zone `nerve_right` and the first molar's crown; without them the
/// result is empty.   [main]
/// Pre: patient axes, both sides alike, the Frankfort horizontal level.
[[nodiscard]] std::vector<MeasuredDimension> measured_mandible(const Anatomy& anatomy);

}  // namespace kerf::documents
