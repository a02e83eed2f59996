// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/field/surface/brick_mesher.h"
#include "core/field/surface/paged_table.h"

namespace kerf {

using PatchTable = PagedTable<BrickPatch>;

}  // namespace kerf
