// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

/// What every code means, for `kerf explain`: those of documents, of data files (E06xx) and of runs (E07xx).
namespace kerf {

struct CodeEntry {
    int number = 0;
    const char* name;     ///< a few words
    const char* meaning;  ///< one sentence
    const char* why;      ///< why this is not let through
    const char* write;    ///< what to do
    bool is_warning = false;
};

/// All of them, by number.   [any]
[[nodiscard]] std::span<const CodeEntry> all_codes() noexcept;

/// "E0412", "W0310" or "412"; nothing if there is no such code.   [any]
[[nodiscard]] const CodeEntry* find_code(std::string_view text) noexcept;

/// A page on one code.   [any]
[[nodiscard]] std::string explanation_of(const CodeEntry& entry);

/// A line for each.   [any]
[[nodiscard]] std::string list_of_codes();

}  // namespace kerf
