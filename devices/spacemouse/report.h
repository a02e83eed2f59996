// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "kerf/math.hpp"

/// The reports of a SpaceMouse, as pure functions.
namespace kerf::spacemouse {

/// What one report states. A report of the battery states nothing.
struct Report {
    std::optional<Vec3> translation{}, rotation{};  ///< [–] -1 to 1 of its range, axes of `kerf/device.h`
    std::optional<std::uint32_t> buttons{};         ///< bit i: button i is pressed
};

/// Reads a report: its id, then little-endian numbers. The device's own axes are x to the right, y towards the user and
/// z down, each from -350 to 350.
///
///     1   translation x y z (i16 each), or 13 bytes: the rotation after it
///     2   rotation x y z (i16 each)
///     3   buttons, 1 to 6 bytes, of which 4 count
///     23  battery
///
/// Returns nothing for other bytes.   [any] pure, nonblocking
///
/// Source: captures of a SpaceNavigator, github.com/AndunHH/spacemouse, SpaceNavigator.md; of a SpaceMouse Wireless,
/// github.com/nytamin/spacemouse, issue 1.
[[nodiscard]] std::optional<Report> decode(std::span<const std::uint8_t> bytes) noexcept;

}  // namespace kerf::spacemouse
