// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "run/scene.h"

namespace kerf {

/// What `kerf anatomy check` says of an anatomy that passed: how it was made, where its landmarks and zones lie to the
/// bone, and how sure its border is.   [main]
[[nodiscard]] std::string anatomy_text(const Scene& scene);

}  // namespace kerf
