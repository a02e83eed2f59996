// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "documents/anatomy.h"
#include "documents/made/measured_dimension.h"

namespace kerf::documents {

/// Returns the dimensions of a vertebra, measured by straight lines through its bone [SI]. It uses the landmarks
/// `right_pedicle` and `midline`; without them the result is empty.   [main]
/// Pre: patient axes, the origin in the middle of the body, both sides alike.
[[nodiscard]] std::vector<MeasuredDimension> measured_vertebra(const Anatomy& anatomy);

}  // namespace kerf::documents
