// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "app/commands.h"
#include "app/installation.h"
#include "app/options.h"
#include "run/documents.h"
#include "run/scene.h"
#include "text/result.h"

/// The documents and the scene that the user names.
namespace kerf::app {

/// Returns what to read for one procedure.   [any]
[[nodiscard]] run::DocumentRequest request_of(const std::string& file, const DocumentOptions& options,
                                              const Installation& here);

/// Reads a procedure and its anatomy, and makes the bone; shows signs of life. Nothing if a document has an error.
/// [main]
[[nodiscard]] text::Result<run::Scene> make_scene(const std::string& file, const DocumentOptions& options,
                                                  const Environment& with,
                                                  const bone::ImportOptions& import_options = {});

/// As make_scene(), and prints the diagnostics to stderr.   [main]
[[nodiscard]] std::optional<run::Scene> read_scene(const std::string& file, const DocumentOptions& options,
                                                   const Environment& with);

}  // namespace kerf::app
