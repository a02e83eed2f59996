// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace kerf {

/// Whether a path leads into a folder once all links on the way are followed. Neither needs to exist. An empty folder
/// is the working folder. Never throws; what cannot be resolved is outside.   [main]
[[nodiscard]] bool is_inside_folder(const std::string& path, const std::string& folder);

}  // namespace kerf
