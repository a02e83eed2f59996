// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/named_setup.h"

#include <vector>

#include "kerf/assert.hpp"

namespace kerf::chart {

namespace {

std::vector<double> values_of(const std::vector<ParameterInfo>& infos, const Values& set) {
    std::vector<double> values;
    for (const ParameterInfo& info : infos) values.push_back(set.contains(info.id) ? set.at(info.id) : info.def);
    return values;
}

}  // namespace

const ComponentInfo* info_of(const PluginRegistry& registry, const std::string& plugin, const std::string& id) {
    for (const ComponentInfo& info : registry.catalog())
        if (info.plugin == plugin && info.id == id) return &info;
    return nullptr;
}

bool NamedSetup::is_in(const PluginRegistry& registry) const {
    return info_of(registry, plugin, tool) != nullptr && info_of(registry, plugin, force) != nullptr;
}

ToolSetup NamedSetup::in(const PluginRegistry& registry) const {
    ToolSetup setup;
    setup.tool = registry.find(plugin, KERF_KIND_TOOL, tool);
    setup.force = registry.find(plugin, KERF_KIND_FORCE, force);
    setup.tool_parameters = values_of(info_of(registry, plugin, tool)->parameters, set);
    setup.drives = values_of(info_of(registry, plugin, tool)->drives, set);
    setup.force_parameters = values_of(info_of(registry, plugin, force)->parameters, set);
    const std::string why_not = bind_law(setup);
    KERF_ASSERT(why_not.empty(), "pair a force with a tool that it takes");
    return setup;
}

Values NamedSetup::all(const PluginRegistry& registry) const {
    Values values = set;
    for (const std::string& id : {tool, force}) {
        const ComponentInfo& info = *info_of(registry, plugin, id);
        for (const ParameterInfo& one : info.parameters) values.insert({one.id, one.def});
        for (const ParameterInfo& one : info.drives) values.insert({one.id, one.def});
    }
    return values;
}

}  // namespace kerf::chart
