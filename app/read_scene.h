// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "app/command_line.h"
#include "core/plugin/loader.h"
#include "run/documents.h"
#include "run/scene.h"

/// The documents and the scene that a command line names.
namespace kerf {

/// Returns what to read for one procedure of the command line.   [any]
[[nodiscard]] DocumentRequest request_of(const std::string& file, const CommandLine& line);

/// Reads a procedure and its anatomy, and makes the bone; shows signs of life. Nothing if a document has an error.
/// [main]
[[nodiscard]] std::optional<Scene> make_scene(const std::string& file, const CommandLine& line,
                                              const PluginRegistry& plugins, Diagnostics& diagnostics,
                                              const ImportOptions& options = {});

/// The same, and prints what was found to stderr.   [main]
[[nodiscard]] std::optional<Scene> read_scene(const std::string& file, const CommandLine& line,
                                              const PluginRegistry& plugins);

}  // namespace kerf
