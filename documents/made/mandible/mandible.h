// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "documents/made/bone_kind.h"

namespace kerf::documents {

/// Returns the kind `mandible`: a lower jaw with teeth from incisors to second molars.   [any]
[[nodiscard]] BoneKind mandible_kind();

}  // namespace kerf::documents
