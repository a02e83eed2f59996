// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "kerf/device.h"

namespace kerf {

/// Returns the bits of the first `count` buttons of a device.   [any] pure
[[nodiscard]] constexpr std::uint32_t button_bits(std::uint32_t count) noexcept {
    return count >= KERF_DEVICE_MAX_BUTTONS ? ~0u : (1u << count) - 1u;
}

}  // namespace kerf
