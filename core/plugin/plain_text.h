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

/// Returns the text with escapes such as `\x1b` for each byte that is not UTF-8 and each byte of a control character
/// (see `is_plain`).   [any]
[[nodiscard]] std::string plain(std::string_view text);

/// Returns `plain(text)` between backticks. Of a text above 60 bytes it keeps the first 60, without cutting a
/// character, and adds "…".   [any]
[[nodiscard]] std::string quoted_plain(std::string_view text);

}  // namespace kerf
