// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

/// `printable` for whole outputs.
namespace kerf {

/// Returns several lines, each printable: line breaks (`\n`, `\r\n`) and tabs stay.   [any] pure.
[[nodiscard]] std::string printable_lines(std::string_view text);

/// Returns JSON whose hidden characters are written as `\u009b`, which every reader takes for the same text.
/// [any] pure. Pre: valid JSON in UTF-8, so that hidden characters other than line breaks lie in strings.
[[nodiscard]] std::string printable_json(std::string_view json);

}  // namespace kerf
