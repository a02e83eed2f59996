// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/haptics/scene/simulation.h"
#include "core/plugin/loader.h"
#include "tests/support/rig.h"

/// The drilling plugin as the host loads it, in a bone made for the question. The bone's face is z = 0, the drill comes
/// from above and feeds along −z.
namespace kerf::test {

inline const PluginRegistry& plugins() {
    static const PluginRegistry registry = [] {
        PluginRegistry r;
        r.scan({KERF_BUILD_DIR "/lib/kerf"});
        return r;
    }();
    return registry;
}

/// Parameters by name; the rest at their defaults.
inline std::vector<double> values(const std::vector<ParameterInfo>& infos, const std::map<std::string, double>& set) {
    std::vector<double> v;
    for (const auto& info : infos) v.push_back(set.contains(info.id) ? set.at(info.id) : info.def);
    return v;
}

/// A powered tool with its law. The motor follows at once unless `set` says otherwise: most questions are about the law
/// at speed.
inline ToolSetup powered_tool(const std::string& plugin, const std::string& tool, const std::string& force,
                              std::map<std::string, double> set) {
    set.insert({"run_up", 0.0});
    ToolSetup setup;
    setup.tool = plugins().find(plugin, KERF_KIND_TOOL, tool);
    setup.force = plugins().find(plugin, KERF_KIND_FORCE, force);
    if (setup.tool == nullptr || setup.force == nullptr) throw std::runtime_error("no " + plugin + " in lib/kerf");
    for (const auto& info : plugins().catalog()) {
        if (info.plugin != plugin) continue;
        if (info.id == tool) {
            setup.tool_parameters = values(info.parameters, set);
            setup.drives = values(info.drives, set);
        }
        if (info.id == force) setup.force_parameters = values(info.parameters, set);
    }
    if (const std::string why = bind_law(setup); !why.empty()) throw std::runtime_error(why);
    return setup;
}
inline ToolSetup drill(const std::string& tool, const std::map<std::string, double>& set) {
    return powered_tool("kerf.drilling", tool, "drill_cutting", set);
}

inline ToolSetup twist_drill(const std::map<std::string, double>& set = {}) { return drill("twist_drill", set); }
inline ToolSetup step_drill(const std::map<std::string, double>& set = {}) { return drill("step_drill", set); }

/// The channels that the law states where the tool is now. Throws if it fails.
inline std::vector<kerf_channel> law_now(const Simulation& simulation) {
    std::vector<kerf_channel> channels(KERF_MAX_CHANNELS);
    kerf_law law{sizeof(kerf_law), 0, channels.data(), {}, {}};
    const ToolSetup& setup = simulation.setup();
    const kerf_tick_in in = tick_in_of(setup, simulation.bone().query(), Simulation::dt);
    if (setup.force->force->resist(&in, simulation.state(), &law) != KERF_OK) throw std::runtime_error("the law fails");
    channels.resize(law.count);
    return channels;
}

}  // namespace kerf::test
