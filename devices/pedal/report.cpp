// SPDX-License-Identifier: Apache-2.0
#include "report.h"

namespace kerf::pedal {

std::optional<std::uint32_t> decode(std::span<const std::uint8_t> bytes) noexcept {
    constexpr std::uint32_t known = (1u << button_count) - 1u;
    if (bytes.size() != 2 || (bytes[0] & ~known) != 0 || bytes[1] != 0) return std::nullopt;
    return bytes[0];
}

}  // namespace kerf::pedal
