// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/haptics/law/tool.h"
#include "run/view/facets.h"

namespace kerf::run {

/// Returns a flat blade with teeth along its front, alternately set to the two sides of its kerf. A blade without a
/// drive has a plain edge. Pre: a prism.   [main]
[[nodiscard]] Facets blade_facets(const Tool& tool);

}  // namespace kerf::run
