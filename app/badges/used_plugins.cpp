// SPDX-License-Identifier: Apache-2.0
#include "app/badges/used_plugins.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "app/badges/loaded_files.h"
#include "app/badges/plugin_verdict.h"
#include "app/standard_streams.h"
#include "text/shell.h"

namespace kerf::app {

namespace {

std::string file_name(const std::string& file) { return std::filesystem::path(file).filename().string(); }

std::string name_of(const std::string& id, const std::string& file) { return "`" + id + "` (" + file_name(file) + ")"; }

/// @param badge  of a lower level; null: none
std::string unchecked(const std::string& id, const std::string& file, const Badge* badge) {
    const std::string level = std::to_string(required_level);
    return name_of(id, file) + " never passed `kerf check` at level " + level + " on this machine" +
           (badge == nullptr ? "" : " (" + words_of(*badge) + ")") + ". Run `kerf check " + text::shell_path(file) +
           " --level " + level + "`.";
}

}  // namespace

void UsedPlugins::add(const documents::Procedure& procedure, const std::string& device) {
    const ComponentCatalog& catalog = with_.plugins.catalog();
    for (const documents::Instrument& instrument : procedure.instruments) {
        if (std::none_of(procedure.steps.begin(), procedure.steps.end(),
                         [&](const documents::Step& step) { return step.instrument == instrument.id; }))
            continue;
        add_one(instrument.plugin, true);
        add_one(instrument.force_plugin, true);
        for (const ComponentInfo& component : catalog)
            if (component.kind == KERF_KIND_REMESHER && component.full_id() == instrument.remeshing)
                add_one(component.plugin, false);
    }
    const std::string driver = device.substr(0, device.find('/'));
    const auto found = std::find_if(catalog.begin(), catalog.end(), [&](const ComponentInfo& component) {
        return component.kind == KERF_KIND_DEVICE && component.matches_id(driver);
    });
    if (!driver.empty() && found != catalog.end()) add_one(found->plugin, true);
}

/// @param is_in_ticks  its code takes part in the ticks: the digest of a shipped plugin is wanted, too
void UsedPlugins::add_one(const std::string& id, bool is_in_ticks) {
    const std::string file = file_of_plugin(with_.plugins, id);
    if (file.empty() || std::any_of(used_.begin(), used_.end(), [&](const Used& one) { return one.id == id; })) return;
    const PluginVerdict verdict = verdict_on(id, file, with_.here, store_, is_in_ticks);
    const bool has_words = verdict.is_shipped || !store_.is_off();
    used_.push_back({id, file, verdict.file.digest, has_words ? verdict.words() : "", verdict.is_shipped});
    if (store_.is_off() || verdict.is_sufficient()) return;
    if (!verdict.fault.empty()) print_error("kerf: " + verdict.fault + "\n");
    if (store_.folder().empty()) {
        if (!std::exchange(has_missed_folder_, true)) print_error("kerf: " + no_folder_for_badges() + "\n");
    } else if (!verdict.is_replaced) {  // warn_of_replaced() names it
        print_error("kerf: " + unchecked(id, file, verdict.badge ? &*verdict.badge : nullptr) + "\n");
    }
}

bool UsedPlugins::is_replaced(const Used& used) {
    if (stamp_of(used.file) == stamp_before_loading(used.file)) return false;
    // A new name or permission of the same bytes is no new file.
    return used.digest.empty() || text::digest_of_file(used.file).digest != used.digest;
}

std::string UsedPlugins::lines() const {
    std::string lines;
    for (const Used& used : used_)
        if (!used.is_shipped && !used.badge.empty())
            lines += "  " + used.id + " (" + file_name(used.file) + "): " + used.badge + "\n";
    return lines;
}

std::vector<std::pair<std::string, std::string>> UsedPlugins::parts() const {
    std::vector<std::pair<std::string, std::string>> parts;
    for (const Used& used : used_) {
        if (used.is_shipped) continue;
        parts.emplace_back(used.id + " file", file_name(used.file));
        parts.emplace_back(used.id + " SHA-256", used.digest);
        if (!used.badge.empty()) parts.emplace_back(used.id + " badge", used.badge);
    }
    return parts;
}

void UsedPlugins::warn_of_replaced() const {
    for (const Used& used : used_)
        if (is_replaced(used))
            print_error("kerf: " + name_of(used.id, used.file) +
                        " was replaced after it was loaded: the result is that of the loaded file, which is no longer "
                        "there. Run the procedure again.\n");
}

}  // namespace kerf::app
