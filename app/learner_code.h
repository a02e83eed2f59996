// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace kerf::app {

/// The end of a message about a text that is no code.
inline constexpr const char* code_rule =
    "must be letters, digits, `.`, `_` and `-`, at most 64, and never a name. Write a code, as in `L17`.";

/// Returns whether a text is a code: 1 to 64 letters, digits, `.`, `_` and `-`.   [any] pure
[[nodiscard]] bool is_code(const std::string& word);

/// Returns what is wrong with the code of a learner, which also names a folder; empty: nothing. No code is right.
/// [any] pure
[[nodiscard]] std::string refusal_of_learner(const std::string& code);

}  // namespace kerf::app
