// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "documents/made/dimension.h"
#include "documents/made/request.h"

namespace kerf::documents {

/// Returns the anatomy of the lower end of a right femur behind `metadata:`: solids, tissues, landmarks and zones.
/// Patient axes, the origin in the middle of the shaft, in the plane of the cut.   [main]
[[nodiscard]] std::string distal_femur_text(const MakeRequest& request, const DimensionValues& femur);

}  // namespace kerf::documents
