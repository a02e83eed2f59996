// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <span>
#include <string>
#include <string_view>

#include "text/code.h"

/// The catalogue of error codes: documents, data files (E06xx) and runs (E07xx). The files `codes_*.def` are the one
/// table; this enumeration, `kerf explain` and docs/codes.md come from it. A number is never reused, so that a search
/// for it finds its meaning.
namespace kerf::text {

enum class Code : int {
// NOLINTNEXTLINE(bugprone-macro-parentheses): an enumerator
#define KERF_CODE(number, id, level, name, meaning, why, write) id = number,
#include "text/codes_1_document.def"
#include "text/codes_5_anatomy.def"
#include "text/codes_6_data.def"
#include "text/codes_7_run.def"
#undef KERF_CODE
};

/// Returns `E0412`; `W0412` for a warning.   [any]
inline std::string code_text(Code code, char letter = 'E') {
    char text[8];
    std::snprintf(text, sizeof text, "%c%04d", letter, static_cast<int>(code) % 10000);
    return text;
}

struct CodeEntry {
    int number = 0;
    const char* id = "";       ///< the name of the enumerator
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

/// Returns the table of docs/codes.md: a row for each code.   [any]
[[nodiscard]] std::string table_of_codes();

}  // namespace kerf::text
