// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/abi.h"

namespace kerf {

/// Returns the components that Kerf has without a plugin, in the same tables: `kerf.core` with forceps, which grip the
/// body at their tip.   [any]
[[nodiscard]] const kerf_entry& core_instruments() noexcept;

}  // namespace kerf
