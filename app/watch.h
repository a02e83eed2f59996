// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/command_line.h"

namespace kerf {

/// `kerf run … --watch`: runs the command, and again whenever a plugin, the procedure or its anatomy has changed, until
/// it is interrupted. Each run is a process of its own, so it loads the plugins anew.   [main]
/// @param program     the file of `kerf`
/// @param arguments   of the command, without `--watch`
/// @param plugins     folders
[[nodiscard]] ExitCode run_and_watch(const CommandLine& line, const std::string& program,
                                     std::vector<std::string> arguments, const std::vector<std::string>& plugins);

}  // namespace kerf
