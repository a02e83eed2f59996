// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "documents/anatomy.h"

namespace kerf::documents {

struct MeasuredDimension {
    std::string name;    ///< that of a dimension
    double value = 0.0;  ///< SI
};

/// Measures a vertebra by straight lines through its bone, from the landmarks `right_pedicle` and `midline` alone. It
/// knows nothing of how the bone was made. Empty without these landmarks.   [main]
[[nodiscard]] std::vector<MeasuredDimension> measured_vertebra(const Anatomy& anatomy);

}  // namespace kerf::documents
