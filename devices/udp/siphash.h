// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace kerf::udp {

using Key = std::array<std::uint8_t, 16>;

/// Returns SipHash-2-4 of a message: a tag that only a holder of the key can compute.   [any] pure.
///
/// Source: Aumasson and Bernstein, "SipHash: a fast short-input PRF", 2012, section 2.
[[nodiscard]] std::uint64_t siphash(std::span<const std::uint8_t> message, const Key& key) noexcept;

}  // namespace kerf::udp
