// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <string_view>

#include "kerf/abi.h"

namespace kerf {

/// A number as text for people: three digits and its unit, independent of the locale.
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
/// Returns a length [m] as text in millimetres.
[[nodiscard]] inline Figure in_mm(double length) noexcept { return Figure(1e3 * length, " mm"); }

}  // namespace kerf
