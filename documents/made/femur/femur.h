// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "documents/made/bone_kind.h"

namespace kerf::documents {

/// Returns the kind `femur`: its upper end with a broken neck, and its lower end.   [any]
[[nodiscard]] BoneKind femur_kind();

}  // namespace kerf::documents
