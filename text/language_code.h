// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace kerf::text {

/// Returns whether a text has the form of a language's code: `en`, `pt-BR`.   [any] pure.
[[nodiscard]] inline bool is_language_code(std::string_view text) {
    const auto are = [](std::string_view part, char from, char to) {
        return std::all_of(part.begin(), part.end(), [=](char c) { return c >= from && c <= to; });
    };
    const std::size_t dash = std::min(text.find('-'), text.size());
    const std::string_view language = text.substr(0, dash);
    const bool has_language = (language.size() == 2 || language.size() == 3) && are(language, 'a', 'z');
    return has_language && (dash == text.size() || (text.size() == dash + 3 && are(text.substr(dash + 1), 'A', 'Z')));
}

}  // namespace kerf::text
