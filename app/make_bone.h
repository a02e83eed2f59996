// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "run/documents.h"
#include "run/scene.h"

namespace kerf {

/// `make_scene`, which may take minutes, with signs of life on stderr. `file` is the procedure's.   [main]
[[nodiscard]] std::optional<Scene> make_bone(Documents documents, const std::string& file, Diagnostics& diagnostics,
                                             ImportOptions options = {});

/// Prints what import did to stderr.   [main]
void print_notes(const std::optional<Scene>& scene);

/// Returns the scene, or nothing; prints what was found, and what import did, to stderr.   [main]
std::optional<Scene> with_findings(std::optional<Scene> scene, const Diagnostics& diagnostics);

}  // namespace kerf
