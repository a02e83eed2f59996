// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace kerf::app {

/// Returns the YAML files in a folder that may be procedures, sorted; none if it cannot be read. A file that states
/// another kind is left out.   [main]
[[nodiscard]] std::vector<std::string> procedures_in(const std::string& folder);

}  // namespace kerf::app
