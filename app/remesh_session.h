// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/command_line.h"
#include "core/plugin/loader.h"
#include "run/exact/exact_strategies.h"

namespace kerf {

/// `kerf remesh SESSION.db`: repeats a session, and makes the exact surface of what it left: bone-exact.stl, one file
/// for each further piece, and remesh.json.   [main]
[[nodiscard]] ExitCode remesh_session(const CommandLine& line, const PluginRegistry& plugins, const StrategyHost& host);

}  // namespace kerf
