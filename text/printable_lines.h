// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

/// `printable` and its JSON form for whole outputs.
namespace kerf::text {

/// Returns several lines, each printable. Line breaks (`\n`, `\r\n`) and tabs stay.   [any] pure.
[[nodiscard]] std::string printable_lines(std::string_view text);

/// Returns the JSON with hidden characters written as `\u009b`, which every reader takes for the same text. Pre: valid
/// JSON in UTF-8, so that hidden characters other than line breaks are in strings.   [any] pure.
[[nodiscard]] std::string printable_json(std::string_view json);

}  // namespace kerf::text
