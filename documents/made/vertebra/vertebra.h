// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "documents/made/bone_kind.h"

namespace kerf::documents {

/// Returns the kind `vertebra`: T11 to L5.   [any]
[[nodiscard]] BoneKind vertebra_kind();

}  // namespace kerf::documents
