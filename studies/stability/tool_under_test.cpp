// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/stability/tool_under_test.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "core/haptics/loop/work_force.h"
#include "documents/yaml/read_map.h"

namespace kerf::stability {

namespace {

constexpr double nominal_feed = 2e-3;  // [m/s]

std::vector<double> defaults(const std::vector<ParameterInfo>& infos) {
    std::vector<double> values;
    for (const ParameterInfo& info : infos) values.push_back(info.def);
    return values;
}

std::vector<std::string> plugins_with_tools(const PluginRegistry& plugins) {
    std::vector<std::string> ids;
    for (const ComponentInfo& info : plugins.catalog())
        if (info.kind == KERF_KIND_TOOL && (ids.empty() || ids.back() != info.plugin)) ids.push_back(info.plugin);
    return ids;
}

}  // namespace

std::optional<ToolUnderTest> find_tool(const PluginRegistry& plugins, const std::string& plugin, std::string& error,
                                       const std::string& force) {
    ToolUnderTest found;
    ToolSetup& setup = found.setup;
    for (const ComponentInfo& info : plugins.catalog()) {
        if (info.plugin != plugin) continue;
        if (info.kind == KERF_KIND_TOOL && setup.tool == nullptr) {
            setup.tool = plugins.find(plugin, info.kind, info.id);
            setup.tool_parameters = defaults(info.parameters);
            setup.drives = defaults(info.drives);
        }
        if (info.kind == KERF_KIND_FORCE && setup.force == nullptr && (force.empty() || force == info.id)) {
            setup.force = plugins.find(plugin, info.kind, info.id);
            found.law = info.id;
            setup.force_parameters = defaults(info.parameters);
        }
    }
    if (setup.tool == nullptr || setup.force == nullptr) {
        error = "there is no plugin `" + plugin + "` with a tool and " +
                (force.empty() ? "a force" : "the force `" + force + "`") + ". " +
                documents::write_instead(plugin, plugins_with_tools(plugins));
        return std::nullopt;
    }
    error = bind_law(setup);
    if (!error.empty()) return std::nullopt;
    ToolOutline outline;
    if (!outline_of(setup, outline, error)) return std::nullopt;
    const auto& profile = outline.cutting.outline();
    const auto widest = std::max_element(profile.begin(), profile.end(),
                                         [](const auto& a, const auto& b) { return a.radius < b.radius; });
    found.full_depth = -widest->z;
    found.radius = widest->radius;
    found.lead = outline.thread_lead;
    return found;
}

std::optional<std::size_t> tool_parameter(const ToolSetup& setup, const char* id) noexcept {
    for (std::uint32_t i = 0; i < setup.tool->param_count; ++i)
        if (std::strcmp(setup.tool->params[i].id, id) == 0) return i;
    return std::nullopt;
}

double push_of(const DeviceRecord& device) noexcept { return std::min(5.0, 0.8 * device.peak_force); }

CouplingGains gains_under_push(const DeviceRecord& device, double push, const ToolUnderTest& tool, const Body& body,
                               int latency) {
    return in_hands(gains_for(device, std::min(1.0, push / work_force(tool.setup, body, nominal_feed)), latency));
}

}  // namespace kerf::stability
