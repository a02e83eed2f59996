// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Why a text is not YAML, in words that say how to mend it.
namespace kerf::documents {

/// A `{`, `[` or quotation mark without its counterpart.
struct Unclosed {
    std::size_t at = 0;         ///< byte in the text
    char closer = '}';          ///< what is missing
    bool is_last_line = false;  ///< nothing follows its line
};

/// Guesses where a text that is not YAML opens something for good. Meant for such texts only: in YAML a bracket within
/// a block of text opens nothing.   [any] pure.
[[nodiscard]] std::optional<Unclosed> find_unclosed(std::string_view text);

/// The same for a text in quotation marks that begins at `at`; nothing if none begins there.   [any] pure.
[[nodiscard]] std::optional<Unclosed> find_unclosed_quote(std::string_view text, std::size_t at);

/// Says what is not closed, and what to write.   [any] pure.
[[nodiscard]] std::string about(const Unclosed& unclosed, char opener);

/// A mistake that makes a text no YAML: where it is, which need not be where a parser notices it.
struct SyntaxMistake {
    std::size_t at = 0;  ///< first byte
    std::size_t size = 1;
    std::string message;  ///< with what to do
    std::string write{};  ///< what to write in place of it; may be empty
};

/// Finds the mistake behind a complaint of yaml-cpp at byte `at` of the text.   [any] pure.
[[nodiscard]] SyntaxMistake explain_syntax(const std::string& complaint, std::string_view text, std::size_t at);

/// Finds `key:value` at the beginning of a text, which YAML does not take for a key and its value; `key: value` is what
/// to write.   [any] pure.
[[nodiscard]] std::optional<SyntaxMistake> find_missing_space(std::string_view text);

/// Finds `-item` at the beginning of a text, which YAML does not take for an item of a list.   [any] pure.
[[nodiscard]] std::optional<SyntaxMistake> find_missing_dash_space(std::string_view text);

/// Finds what is not closed if a complaint of yaml-cpp at byte `at` may come from that.   [any] pure.
[[nodiscard]] std::optional<Unclosed> find_unclosed_for(const std::string& complaint, std::string_view text,
                                                        std::size_t at);

/// Numbers with commas and blanks between them, the last one with a unit: `44, 35, 28 mm`.
struct NumberRow {
    std::vector<std::string_view> numbers;
    std::size_t size = 0;  ///< bytes of the row; 0 if there is no second number

    [[nodiscard]] std::string text(std::string_view between) const;
};

/// Finds the row of numbers that begins at `at`.   [any] pure.
[[nodiscard]] NumberRow find_number_row(std::string_view text, std::size_t at);

}  // namespace kerf::documents
