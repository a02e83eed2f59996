// SPDX-License-Identifier: Apache-2.0
#include "core/plugin/reserved_names.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "core/plugin/plain_text.h"

namespace kerf {

namespace {

struct Names {
    std::string own_folder;
    std::vector<std::string> allowed, foreign;
};
Names& names() {
    static Names one;
    return one;
}

bool has(const std::vector<std::string>& ids, const std::string& id) {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
}

}  // namespace

void reserve_names(std::string own_folder, std::vector<std::string> allowed) {
    names() = {std::move(own_folder), std::move(allowed), {}};
}

std::string refusal_of_name(const std::string& plugin_id, const std::string& file) {
    std::error_code error;
    const bool is_own =
        std::filesystem::equivalent(std::filesystem::path(file).parent_path(), names().own_folder, error);
    if (names().own_folder.empty() || !plugin_id.starts_with("kerf.") || is_own) return {};
    if (!has(names().allowed, plugin_id))
        return "its id begins with `kerf.`, as those of Kerf's own plugins in " + plain(names().own_folder) +
               ". Give it another id, or write `KERF_PLUGIN_ALLOW=" + plain(plugin_id) +
               "` before the command to use it in one run, which is recorded.";
    names().foreign.push_back(plugin_id);
    return {};
}

bool is_foreign_name(const std::string& plugin_id) { return has(names().foreign, plugin_id); }

}  // namespace kerf
