// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <system_error>

namespace kerf::app {

/// Returns the seconds, 0 or more, that a text such as "20.5" states; nothing for any other text.   [any] pure
[[nodiscard]] inline std::optional<double> seconds_of(const std::string& text) {
    double value = 0.0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool is_whole = status == std::errc{} && end == text.data() + text.size();
    return is_whole && std::isfinite(value) && value >= 0.0 ? std::optional(value) : std::nullopt;
}

}  // namespace kerf::app
