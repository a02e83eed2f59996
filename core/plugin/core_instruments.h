// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/abi.h"

namespace kerf {

/// What every Kerf has without a plugin, through the same tables: `kerf.core` with forceps, which hold what they close
/// on.   [any]
[[nodiscard]] const kerf_entry& core_instruments() noexcept;

}  // namespace kerf
