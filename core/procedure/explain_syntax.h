// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

/// Why a text is not YAML, in the words of somebody who wants to mend it.
namespace kerf {

/// A `{`, `[` or quotation mark that nothing closes.
struct Unclosed {
    std::size_t at = 0;         ///< byte in the text
    char closer = '}';          ///< what is missing
    bool is_last_line = false;  ///< nothing follows the line it stands in
};

/// Guesses where a text that is not YAML opens something for good. Meant for such texts only: in YAML a bracket within
/// a block of text opens nothing.   [any] pure.
[[nodiscard]] std::optional<Unclosed> find_unclosed(std::string_view text);

/// The same for a text in quotation marks that begins at `at`; nothing if none begins there.   [any] pure.
[[nodiscard]] std::optional<Unclosed> find_unclosed_quote(std::string_view text, std::size_t at);

/// What to tell of it, and what to write.   [any] pure.
[[nodiscard]] std::string about(const Unclosed& unclosed, char opener);

/// What a complaint of yaml-cpp about `line` means; the complaint itself where there is nothing to add.   [any] pure.
[[nodiscard]] std::string explain_syntax(const std::string& complaint, std::string_view line);

/// True if the complaint may come from something that is not closed.   [any] pure.
[[nodiscard]] bool is_about_an_end(const std::string& complaint);

}  // namespace kerf
