// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace kerf::app {

/// Returns whether a text is a code: 1 to 64 letters, digits, `.`, `_` and `-`.   [any] pure
[[nodiscard]] bool is_code(const std::string& word);

/// Returns what is wrong with the code of a learner, which also names a folder; empty: nothing. No code is right.
/// [any] pure
[[nodiscard]] std::string refusal_of_learner(const std::string& code);

}  // namespace kerf::app
