// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/exit_code.h"
#include "app/options.h"

namespace kerf::app {

/// `kerf run … --watch`: runs the command, and again whenever a plugin, the procedure, its anatomy or a data file of
/// them has changed, until Ctrl-C. Each run is a process of its own, so it loads the plugins again.   [main]
/// @param program     the file of `kerf`
/// @param arguments   the arguments of the command, without `--watch`
/// @param plugins     folders
[[nodiscard]] ExitCode run_and_watch(const RunOptions& options, const std::string& program,
                                     std::vector<std::string> arguments, const std::vector<std::string>& plugins);

}  // namespace kerf::app
