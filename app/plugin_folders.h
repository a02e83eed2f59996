// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kerf {

/// Where plugins are looked for, and what is wrong with what the user said of it.
struct PluginFolders {
    std::vector<std::string> folders;     ///< each once, in the order of the search
    std::vector<std::string> complaints;  ///< for people
};

/// The folders of KERF_PLUGIN_PATH, separated by `:`, then `own`.   [main]
[[nodiscard]] PluginFolders plugin_folders(std::string_view plugin_path, const std::string& own);

}  // namespace kerf
