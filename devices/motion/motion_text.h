// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "devices/motion/motion.h"

/// The text of a motion: one row a line, nine numbers separated by commas; docs/guide/devices.md describes it.
namespace kerf::motion {

inline constexpr std::size_t max_rows = 3'600'000;  ///< an hour at 1 kHz
inline constexpr std::size_t max_line = 256;        ///< [bytes]

/// Reads the rows of a motion. Lines that are empty or begin with `#` are skipped. Times must rise from 0 on, positions
/// be at most 2 m from the origin along each axis, and rotations be unit quaternions within 1e-3; they are normalised.
/// Returns nothing, with the line and the reason in `error`, if a row is something else, or if there is none.
/// [any] pure
[[nodiscard]] std::optional<std::vector<MotionRow>> parse_motion(std::string_view text, std::string& error);

/// Returns the text of a motion, which `parse_motion` reads as the same rows.   [any] pure
/// @param notice  for the first line, a comment that also names the columns
[[nodiscard]] std::string text_of(std::span<const MotionRow> rows, std::string_view notice);

}  // namespace kerf::motion
