// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

/// Text of a plugin, made fit for a terminal.
namespace kerf {

/// Whether it is UTF-8 without overlong forms, surrogates or numbers beyond U+10FFFF.   [any] pure.
[[nodiscard]] bool is_utf8(std::string_view text) noexcept;

/// Whether UTF-8 text holds no control character: none of C0 and C1, no DEL, and none that turns the direction of what
/// follows.   [any] pure.
[[nodiscard]] bool is_plain(std::string_view text) noexcept;

/// The text with each byte of what is neither UTF-8 nor plain as `\x1b`.   [any]
[[nodiscard]] std::string plain(std::string_view text);

/// The same between backticks, cut at 60 bytes with "…".   [any]
[[nodiscard]] std::string quoted_plain(std::string_view text);

}  // namespace kerf
