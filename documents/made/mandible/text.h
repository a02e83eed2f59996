// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "documents/made/dimension.h"
#include "documents/made/request.h"

namespace kerf::documents {

/// Returns the anatomy of a lower jaw behind `metadata:`: solids, tissues, landmarks and zones, and the plan of a
/// reduction of its angles.   [main]
[[nodiscard]] std::string mandible_text(const MakeRequest& request, const DimensionValues& mandible);

}  // namespace kerf::documents
