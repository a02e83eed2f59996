// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/command_line.h"
#include "core/plugin/loader.h"

namespace kerf {

/// Does what was asked, prints what came of it, and says how the program ends.   [main]
[[nodiscard]] ExitCode carry_out(const CommandLine& line, const PluginRegistry& plugins);

}  // namespace kerf
