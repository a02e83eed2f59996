// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "run/scene.h"

namespace kerf::app {

/// Returns the text that `kerf anatomy check` prints for an anatomy without errors: the notes of import, the positions
/// of landmarks and zones relative to the bone, and the uncertainty of its border.   [main]
[[nodiscard]] std::string anatomy_text(const run::Scene& scene);

}  // namespace kerf::app
