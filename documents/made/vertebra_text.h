// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "documents/made/dimension.h"

namespace kerf::documents {

/// Returns the anatomy of a vertebra behind `metadata:`: solids, tissues, landmarks and zones. Patient axes, the origin
/// in the middle of the body.   [main]
[[nodiscard]] std::string vertebra_text(const std::string& level, const DimensionValues& vertebra);

}  // namespace kerf::documents
