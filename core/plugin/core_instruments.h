// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/abi.h"

namespace kerf {

/// Returns the entry of `kerf.core`, the components that are built into Kerf: forceps, which grip the body at their
/// tip. [any]
[[nodiscard]] const kerf_entry& core_instruments() noexcept;

}  // namespace kerf
