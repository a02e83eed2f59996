// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace kerf::text {

/// Returns whether a path leads into a folder after all links are resolved. Neither needs to exist. An empty folder
/// means the working folder. A path that cannot be resolved is outside. Never throws.   [main]
[[nodiscard]] bool is_inside_folder(const std::string& path, const std::string& folder);

}  // namespace kerf::text
