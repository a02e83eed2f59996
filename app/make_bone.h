// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "run/documents.h"
#include "run/scene.h"
#include "text/result.h"

namespace kerf {

/// Makes the scene, which may take minutes, and shows progress on stderr.   [main]
/// @param file   name of the procedure, for the progress
[[nodiscard]] Result<Scene> make_bone(Documents documents, const std::string& file, ImportOptions options = {});

/// Prints the notes of import to stderr.   [main]
void print_notes(const std::optional<Scene>& scene);

/// Prints the diagnostics and the notes of import to stderr. Returns `scene`.   [main]
std::optional<Scene> with_findings(std::optional<Scene> scene, const Diagnostics& diagnostics);

}  // namespace kerf
