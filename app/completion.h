// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace kerf::app {

/// Returns a script that completes commands, options, words and file names of `kerf`, from the table of commands.
/// [any]
/// @param shell   bash, zsh or fish
[[nodiscard]] std::string completion_script(const std::string& shell);

}  // namespace kerf::app
