// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "documents/made/dimension.h"
#include "documents/made/request.h"

namespace kerf::documents {

/// Returns the anatomy of a vertebra behind `metadata:`: solids, tissues, landmarks and zones. Patient axes, the origin
/// in the middle of the body.   [main]
[[nodiscard]] std::string vertebra_text(const MakeRequest& request, const DimensionValues& vertebra);

}  // namespace kerf::documents
