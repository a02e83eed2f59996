// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kerf::app {

/// The folders that are searched for plugins, and the mistakes in KERF_PLUGIN_PATH.
struct PluginFolders {
    std::vector<std::string> folders;     ///< each once, in search order
    std::vector<std::string> complaints;  ///< for people
};

/// Returns the folders of `plugin_path`, which `:` separates, then `own`.   [main]
[[nodiscard]] PluginFolders plugin_folders(std::string_view plugin_path, const std::string& own);

}  // namespace kerf::app
