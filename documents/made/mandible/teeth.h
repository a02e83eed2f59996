// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "documents/made/mandible/bone.h"

namespace kerf::documents {

/// Returns how long the row of the seven teeth of one side is, at the width of a first molar.   [any]
[[nodiscard]] double row_of_teeth(double first_molar_width);

/// Returns how far the middle of the first molar is from the midline along the row, at its width.   [any]
[[nodiscard]] double first_molar_from_midline(double first_molar_width);

/// Returns necks and crowns of the teeth as parts of a phantom. Their roots are not modelled.   [main]
/// @param first_molar_width  mesiodistal [mm]; all teeth are of its size
[[nodiscard]] std::string teeth_parts(const std::vector<CrestPoint>& crest, double first_molar_width);

}  // namespace kerf::documents
