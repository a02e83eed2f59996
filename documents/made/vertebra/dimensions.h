// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "documents/made/draw.h"
#include "documents/made/request.h"

namespace kerf::documents {

/// Returns the levels of vertebrae that can be made, from the head down.
[[nodiscard]] const std::vector<std::string>& vertebra_levels();

/// Returns the dimensions of vertebrae at a level, in adults of one sex; of both together if it is unsaid. Age and
/// osteoporosis set the density.   Pre: the level is one of `vertebra_levels()`.   [main]
[[nodiscard]] Population vertebra_population(const MakeRequest& request);

/// Returns the anterior height of the body [m].
[[nodiscard]] double anterior_height(const DimensionValues& vertebra);

}  // namespace kerf::documents
