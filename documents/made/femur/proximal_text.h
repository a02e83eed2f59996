// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "documents/made/dimension.h"
#include "documents/made/request.h"

namespace kerf::documents {

/// Returns the anatomy of the upper end of a left femur behind `metadata:`: solids, tissues, fracture, landmarks and
/// zones. Patient axes, the origin where the axes of neck and shaft meet, the neck in the plane y = 0.   [main]
[[nodiscard]] std::string proximal_femur_text(const MakeRequest& request, const DimensionValues& femur);

}  // namespace kerf::documents
