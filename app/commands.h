// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/command_line.h"
#include "app/installation.h"
#include "core/plugin/loader.h"

namespace kerf {

/// Runs a command that is part of `kerf`, prints its result and returns how the program ends.   [main]
[[nodiscard]] ExitCode run_command(const CommandLine& line, const PluginRegistry& plugins, const Installation& here);

}  // namespace kerf
