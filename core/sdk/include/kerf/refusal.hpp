// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <string_view>

#include "kerf/abi.h"

namespace kerf {

/// A number as people read it: three digits and its unit, whatever the locale.
class Figure {
public:
    explicit Figure(double value, std::string_view unit = {}) noexcept {
        char* end = std::to_chars(text_, text_ + longest_number, value, std::chars_format::general, 3).ptr;
        size_ = static_cast<std::size_t>(
            std::copy_n(unit.begin(), std::min(unit.size(), sizeof text_ - longest_number), end) - text_);
    }
    [[nodiscard]] operator std::string_view() const noexcept { return {text_, size_}; }

private:
    static constexpr std::size_t longest_number = 24;
    char text_[40];
    std::size_t size_;
};
/// @param length [m]
[[nodiscard]] inline Figure in_mm(double length) noexcept { return Figure(1e3 * length, " mm"); }

/// What `shape` returns for parameters that no tool can be made of, each within its range but not all of them together:
/// which, what they are, and what is needed. What is longer than there is room for is cut off.
///
///     return refuse(out, "`shoulder_diameter` is ", in_mm(3.0_mm), "; it needs more than `diameter`, ", in_mm(4.0_mm),
///     ".");
///
/// [main] pure.
template <typename... Pieces>
kerf_status refuse(kerf_tool_shape* out, const Pieces&... pieces) noexcept {
    std::size_t at = 0;
    const auto add = [&](std::string_view piece) {
        const std::size_t room = sizeof out->refusal - 1 - at;
        at = static_cast<std::size_t>(std::copy_n(piece.begin(), std::min(room, piece.size()), out->refusal + at) -
                                      out->refusal);
    };
    (add(static_cast<std::string_view>(pieces)), ...);
    out->refusal[at] = '\0';
    return KERF_OUT_OF_RANGE;
}

}  // namespace kerf
