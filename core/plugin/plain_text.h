// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

/// Makes text of a plugin safe for a terminal.
namespace kerf {

/// Returns whether a text is UTF-8 without overlong forms, surrogates or codes beyond U+10FFFF.   [any] pure.
[[nodiscard]] bool is_utf8(std::string_view text) noexcept;

/// Returns whether UTF-8 text has no control character: none of C0 and C1, no DEL, and none that changes the direction
/// of text.   [any] pure.
[[nodiscard]] bool is_plain(std::string_view text) noexcept;

/// Returns the text with each byte that is not UTF-8, or part of a control character, as an escape such as `\x1b`.
/// [any]
[[nodiscard]] std::string plain(std::string_view text);

/// Returns the escaped text between backticks, cut at 60 bytes with "…".   [any]
[[nodiscard]] std::string quoted_plain(std::string_view text);

}  // namespace kerf
