// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

/// The catalogue of error codes for `kerf explain`: documents, data files (E06xx) and runs (E07xx).
namespace kerf {

struct CodeEntry {
    int number = 0;
    const char* name = "";     ///< a few words
    const char* meaning = "";  ///< the problem
    const char* why = "";      ///< the reason why Kerf refuses it
    const char* write = "";    ///< the correction
    bool is_warning = false;
};

/// Returns all codes, by number.   [any]
[[nodiscard]] std::span<const CodeEntry> all_codes() noexcept;

/// Returns the entry of "E0412", "W0310" or "412"; null for an unknown code.   [any]
[[nodiscard]] const CodeEntry* find_code(std::string_view text) noexcept;

/// Returns the page of `kerf explain` on one code.   [any]
[[nodiscard]] std::string explanation_of(const CodeEntry& entry);

/// Returns a list with one line per code.   [any]
[[nodiscard]] std::string list_of_codes();

}  // namespace kerf
