// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

/// Text that comes out of a file, made safe to show on a terminal, in HTML and in JSON.
namespace kerf {

/// Returns the text with every character escaped that a terminal or a reader would not see as a letter: control
/// characters (also those above ASCII), marks that turn the direction of writing, invisible marks, line separators and
/// bytes that are not UTF-8. The form of an escape is that of YAML's double quotes: `\x1b`, `\u202e`. What is valid and
/// visible stays as it is.   [any] pure.
[[nodiscard]] std::string printable(std::string_view text);

/// Returns at most `most` characters of the text, printable. What is cut off is counted: `abc… (12 more characters)`.
/// [any] pure.
[[nodiscard]] std::string excerpt(std::string_view text, std::size_t most = 60);

/// Returns the whole text as a scalar of YAML in double quotes, which reads back as the same text.   [any] pure.
/// Pre: the text is UTF-8; other bytes read back as other characters.
[[nodiscard]] std::string yaml_quoted(std::string_view text);

/// Returns the text itself if YAML reads it as one plain word that is no number; otherwise in double quotes.
/// [any] pure.
[[nodiscard]] std::string yaml_word(std::string_view text);

}  // namespace kerf
