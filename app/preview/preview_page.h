// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "run/scene.h"

namespace kerf {

/// One page that shows a scene before anything is cut: from outside, and cut along and across each step's axis with the
/// tool at its goal; landmarks with their tolerance, and what import did. Nothing in it is fetched, and nothing tells
/// whose bone it is.   [main]
[[nodiscard]] std::string preview_page(const Scene& scene);

}  // namespace kerf
