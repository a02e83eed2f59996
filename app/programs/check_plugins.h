// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/command_line.h"
#include "app/installation.h"

namespace kerf {

/// `kerf check`: tests plugins in child processes, prints what was found and how the program ends. It loads none of
/// them.   [main]
[[nodiscard]] ExitCode check_plugins(const CommandLine& line, const Installation& here);

}  // namespace kerf
