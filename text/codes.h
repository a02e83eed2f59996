// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

/// The catalogue of error codes, for `kerf explain`: of documents, of data files (E06xx) and of runs (E07xx).
namespace kerf {

struct CodeEntry {
    int number = 0;
    const char* name = "";     ///< a few words
    const char* meaning = "";  ///< what is wrong
    const char* why = "";      ///< why Kerf refuses it
    const char* write = "";    ///< what to do
    bool is_warning = false;
};

/// Returns all codes, by number.   [any]
[[nodiscard]] std::span<const CodeEntry> all_codes() noexcept;

/// Finds "E0412", "W0310" or "412"; null if there is no such code.   [any]
[[nodiscard]] const CodeEntry* find_code(std::string_view text) noexcept;

/// Returns a page on one code.   [any]
[[nodiscard]] std::string explanation_of(const CodeEntry& entry);

/// Returns a line for each code.   [any]
[[nodiscard]] std::string list_of_codes();

}  // namespace kerf
