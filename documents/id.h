// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string_view>

namespace kerf::documents {

/// Returns whether a text is an id: letters, digits, `.`, `_` and `-`, a letter or digit first, at most 64.
/// [any] pure.
[[nodiscard]] inline bool is_id(std::string_view text) {
    const auto is_alphanumeric = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    };
    return !text.empty() && text.size() <= 64 && is_alphanumeric(text[0]) &&
           std::all_of(text.begin(), text.end(),
                       [&](char c) { return is_alphanumeric(c) || c == '.' || c == '_' || c == '-'; });
}

}  // namespace kerf::documents
