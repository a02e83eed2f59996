// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/command_line.h"
#include "core/plugin/loader.h"

namespace kerf {

/// Does what was asked, prints what came of it, and says how the program ends.   [main]
/// @param printed  folder of plugins that no procedure may use: laws as the papers print them, for charts
[[nodiscard]] ExitCode carry_out(const CommandLine& line, const PluginRegistry& plugins, const std::string& printed);

}  // namespace kerf
