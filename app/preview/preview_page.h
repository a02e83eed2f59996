// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "run/scene.h"

namespace kerf::app {

/// Returns a page that shows a scene before it is cut: from outside, and in sections along and across each step's axis
/// with the tool at its goal; landmarks with their tolerance, and the notes of import. The page loads no other file and
/// contains no personal data.   [main]
[[nodiscard]] std::string preview_page(const run::Scene& scene);

}  // namespace kerf::app
