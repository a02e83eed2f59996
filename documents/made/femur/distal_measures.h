// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "documents/anatomy.h"
#include "documents/made/measured_dimension.h"

namespace kerf::documents {

/// Returns the dimensions of the lower end of a femur, measured by straight lines through its bone [SI]. It uses the
/// landmarks `medial_epicondyle` and `lateral_epicondyle`; without them the result is empty.   [main]
/// Pre: patient axes, the shaft along z, the origin on its axis.
[[nodiscard]] std::vector<MeasuredDimension> measured_distal_femur(const Anatomy& anatomy);

}  // namespace kerf::documents
