// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>

/// The reports of an Infinity foot pedal, as pure functions.
namespace kerf::pedal {

inline constexpr std::uint32_t button_count = 3;  ///< left, middle, right

/// Reads a report: two bytes, the first with a bit for each pressed pedal from the left, the second zero. Returns the
/// mask of the pressed buttons; nothing for other bytes.   [any] pure, nonblocking
///
/// Source: github.com/fenimore/scribouillage, driver.go, which lists all eight reports; the same bits in
/// github.com/breedx2/infinity-footpedal, pedal.c.
[[nodiscard]] std::optional<std::uint32_t> decode(std::span<const std::uint8_t> bytes) noexcept;

}  // namespace kerf::pedal
