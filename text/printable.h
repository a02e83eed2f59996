// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

/// Makes text from a file safe to show on a terminal, in HTML and in JSON.
namespace kerf::text {

/// Returns the text with all characters escaped that a terminal or a reader would not see as a letter. These are
/// control characters (also above ASCII), marks of writing direction, invisible marks, line separators and bytes that
/// are not UTF-8. Escapes have the form of YAML's double quotes: `\x1b`, `\u202e`. Valid visible characters stay
/// unchanged.   [any] pure.
[[nodiscard]] std::string printable(std::string_view text);

/// Returns at most `most` characters of the text, printable, and the count of the omitted ones: `abc… (12 more
/// characters)`. [any] pure.
[[nodiscard]] std::string excerpt(std::string_view text, std::size_t most = 60);

/// Returns the whole text as a YAML scalar in double quotes, which reads back as the same text. Pre: the text is UTF-8;
/// other bytes read back as other characters.   [any] pure.
[[nodiscard]] std::string yaml_quoted(std::string_view text);

/// Returns the text itself if YAML reads it as one plain word that is not a number; otherwise in double quotes.
/// [any] pure.
[[nodiscard]] std::string yaml_word(std::string_view text);

}  // namespace kerf::text
