// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "documents/made/draw.h"
#include "documents/made/request.h"

namespace kerf::documents {

/// Returns the dimensions of lower jaws with teeth, in adults of one sex; of both together if it is unsaid. Age changes
/// none; osteoporosis thins the cortex a little.   [main]
[[nodiscard]] Population mandible_population(const MakeRequest& request);

}  // namespace kerf::documents
