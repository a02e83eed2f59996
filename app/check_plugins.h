// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/command_line.h"

namespace kerf {

/// `kerf check`: tests plugins in child processes, prints what was found and how the program ends. It loads none of
/// them.   [main]
/// @param program   the file of `kerf`, beside whose folder kerf-check-child is
[[nodiscard]] ExitCode check_plugins(const CommandLine& line, const std::string& program);

}  // namespace kerf
