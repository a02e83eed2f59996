// SPDX-License-Identifier: Apache-2.0
#include "app/plugin_folders.h"

#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <system_error>

namespace kerf::app {

namespace fs = std::filesystem;

PluginFolders plugin_folders(std::string_view plugin_path, const std::string& own) {
    PluginFolders found;
    const auto is_listed = [&](const fs::path& folder) {
        return std::any_of(found.folders.begin(), found.folders.end(), [&](const std::string& f) {
            std::error_code error;
            return fs::equivalent(f, folder, error);
        });
    };
    std::vector<std::string> complained;
    while (!plugin_path.empty()) {
        const std::size_t end = std::min(plugin_path.find(':'), plugin_path.size());
        const std::string folder(plugin_path.substr(0, end));
        plugin_path.remove_prefix(std::min(end + 1, plugin_path.size()));
        std::error_code error;
        if (folder.empty() || is_listed(folder)) continue;
        const bool is_folder = fs::is_directory(folder, error);
        if (is_folder && access(folder.c_str(), R_OK | X_OK) == 0) {
            found.folders.push_back(folder);
            if (const fs::directory_iterator entries(folder, error); error)
                found.complaints.push_back("KERF_PLUGIN_PATH names `" + folder + "`, which cannot be read (" +
                                           error.message() +
                                           "): no plugins come from there. Let this user read it, or take it out.");
        } else if (std::find(complained.begin(), complained.end(), folder) == complained.end()) {
            complained.push_back(folder);
            found.complaints.push_back("KERF_PLUGIN_PATH names `" + folder + "`, which " +
                                       (is_folder                   ? "may not be read"
                                        : fs::exists(folder, error) ? "is not a folder"
                                                                    : "does not exist") +
                                       ": no plugins come from there. Correct it or take it out.");
        }
    }
    if (!is_listed(own)) found.folders.push_back(own);
    return found;
}

}  // namespace kerf::app
