// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "conformance/acceptance_file.h"

namespace kerf::conformance {

/// Forces over ticks as recorded and as found, as SVG.   [any]
[[nodiscard]] std::string difference_svg(const AcceptanceFile& recorded, const std::vector<AcceptanceRow>& found);

}  // namespace kerf::conformance
