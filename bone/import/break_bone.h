// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bone/report/import_report.h"
#include "core/field/grid/body.h"
#include "documents/anatomy.h"
#include "text/result.h"

namespace kerf::bone {

/// Splits the whole bone at the anatomy's fracture. Returns the fragment at its position in the whole bone; `bone`
/// keeps the rest. Both keep the tissues of the whole bone, so the fracture has no new cortex. Error: E0605, one side
/// of the fracture has no bone; then `bone` is unchanged.   [main]
[[nodiscard]] text::Result<Body> break_bone(Body& bone, const documents::Anatomy& anatomy, ImportReport& report);

}  // namespace kerf::bone
