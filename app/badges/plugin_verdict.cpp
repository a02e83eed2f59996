// SPDX-License-Identifier: Apache-2.0
#include "app/badges/plugin_verdict.h"

#include <filesystem>
#include <system_error>
#include <utility>

#include "app/badges/loaded_files.h"

namespace kerf::app {

std::string PluginVerdict::words() const {
    if (is_shipped) return "shipped with Kerf";
    if (is_replaced) return "not known, because its file was replaced after it was loaded";
    if (badge) return words_of(*badge);
    return file.error.empty() ? "never checked" : "not known, because its file cannot be read: " + file.error;
}

PluginVerdict verdict_on(const std::string& id, const std::string& file, const Installation& here,
                         const BadgeStore& store, bool wants_digest) {
    PluginVerdict verdict;
    std::error_code error;
    const auto folder = std::filesystem::path(file).parent_path();
    verdict.is_shipped = id.starts_with("kerf.") && std::filesystem::equivalent(folder, here.plugins(), error);
    if (verdict.is_shipped && !wants_digest) return verdict;
    verdict.file = text::digest_of_file(file);
    verdict.is_replaced = verdict.file.stamp != stamp_before_loading(file);
    if (verdict.is_replaced) verdict.file.digest.clear();
    if (verdict.is_shipped || store.is_off()) return verdict;
    BadgeStore::Found found = store.find(verdict.file.digest);
    verdict.badge = std::move(found.badge);
    verdict.fault = std::move(found.fault);
    return verdict;
}

std::string file_of_plugin(const PluginRegistry& plugins, const std::string& id) {
    for (const ComponentInfo& component : plugins.catalog())
        if (component.plugin == id) return component.module;
    return {};
}

}  // namespace kerf::app
