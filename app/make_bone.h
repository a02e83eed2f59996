// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "run/documents.h"
#include "run/scene.h"
#include "text/result.h"

namespace kerf::app {

/// Makes the scene, which may take minutes, and shows progress on stderr.   [main]
/// @param file   name of the procedure, for the progress
/// @param also   called as well with the fraction of the present part that is done [–]; may be empty
[[nodiscard]] text::Result<run::Scene> make_bone(run::Documents documents, const std::string& file,
                                                 bone::ImportOptions options = {},
                                                 const std::function<void(double)>& also = {});

/// Prints the notes of import to stderr.   [main]
void print_notes(const std::optional<run::Scene>& scene);

/// Prints the diagnostics and the notes of import to stderr. Returns `scene`.   [main]
std::optional<run::Scene> with_findings(std::optional<run::Scene> scene, const text::Diagnostics& diagnostics);

}  // namespace kerf::app
