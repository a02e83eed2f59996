// SPDX-License-Identifier: Apache-2.0
#include "conformance/subject.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "kerf/units.hpp"

namespace kerf::conformance {

namespace {

/// Whether the law takes the tool.
bool takes(const kerf_component& force, const kerf_component& tool) {
    ToolSetup setup;
    setup.tool = &tool;
    setup.force = &force;
    return bind_law(setup).empty();
}

// ---- a stand-in ---------------------------------------------------------------------------------------------------

constexpr double radius = 2e-3;  // [m]

kerf_status stand_in_shape(const double*, kerf_tool_shape* out) {
    constexpr int pieces = 12;
    constexpr double back = 150.0 * pi / 180.0;
    if (out->profile_capacity < pieces + 2) return KERF_CAPACITY;
    for (int i = 0; i <= pieces; ++i) {
        const double angle = back * i / pieces;
        out->profile[i] = {radius * (std::cos(angle) - 1.0), radius * std::sin(angle)};
    }
    out->profile[pieces + 1] = {-60e-3, 0.5 * radius};
    out->profile_count = pieces + 2;
    out->cutting_count = pieces + 1;
    out->grip_z = -90e-3;
    return KERF_OK;
}

/// A value that a tool of this size would have.
double plausible(const kerf_dimension& dimension) {
    if (dimension == dimension::length) return 2.0 * radius;
    if (dimension == dimension::frequency) return 20000.0 / 60.0;
    return 1.0;
}

struct StandIn {
    std::vector<kerf_param> params;
    std::vector<kerf_drive> drives;
    kerf_tool tool{};
    kerf_component component{};
};

std::vector<double> defaults_of(const kerf_param* rows, std::uint32_t count) {
    std::vector<double> values;
    for (std::uint32_t i = 0; i < count; ++i) values.push_back(rows[i].def);
    return values;
}

}  // namespace

const kerf_component& stand_in_for(const kerf_component& law) {
    static std::vector<std::unique_ptr<StandIn>> all;  // their addresses are kept
    auto made = std::make_unique<StandIn>();
    for (std::uint32_t i = 0; i < law.force->need_count; ++i) {
        const kerf_need& need = law.force->needs[i];
        const double value = plausible(need.dimension);
        if (need.kind == KERF_NEED_DRIVE)
            made->drives.push_back({need.id, need.help, need.dimension, "", 0.0, 2.0 * value, value, 0.0});
        else
            made->params.push_back(
                {need.id, need.help, need.dimension, "", 0.5 * value, 2.0 * value, value, "a stand-in"});
    }
    made->tool = {.size = sizeof(kerf_tool),
                  .drive_count = static_cast<std::uint32_t>(made->drives.size()),
                  .drives = made->drives.data(),
                  .strategies = nullptr,
                  .strategy_count = 0,
                  .feed = KERF_FEED_AXIS,
                  .shape = &stand_in_shape};
    made->component = {.size = sizeof(kerf_component),
                       .kind = KERF_KIND_TOOL,
                       .version = KERF_TOOL_VERSION,
                       .param_count = static_cast<std::uint32_t>(made->params.size()),
                       .feature_count = 0,
                       .reserved = 0,
                       .id = "stand_in",
                       .help = "A powered ball.",
                       .params = made->params.data(),
                       .features = nullptr,
                       .table = &made->tool};
    all.push_back(std::move(made));
    return all.back()->component;
}

ToolSetup Subject::setup() const {
    ToolSetup setup;
    setup.tool = tool;
    setup.force = force;
    setup.tool_parameters = defaults_of(tool->params, tool->param_count);
    for (std::uint32_t i = 0; i < tool->tool->drive_count; ++i) setup.drives.push_back(tool->tool->drives[i].def);
    if (force == nullptr) return setup;
    setup.force_parameters = defaults_of(force->params, force->param_count);
    static_cast<void>(bind_law(setup));  // it took the tool when the subject was listed
    return setup;
}

std::vector<SubjectName> subjects_of(const kerf_entry& entry) {
    std::vector<SubjectName> names{{}};
    const auto& all = entry.components;
    for (int i = 0; i < static_cast<int>(entry.component_count); ++i)
        if (all[i].kind == KERF_KIND_TOOL) names.push_back({Scope::tool, all[i].id, i, -1});
    for (int i = 0; i < static_cast<int>(entry.component_count); ++i)
        if (all[i].kind == KERF_KIND_REMESHER) names.push_back({Scope::strategy, all[i].id, -1, -1, i});
    for (int i = 0; i < static_cast<int>(entry.component_count); ++i)
        if (all[i].kind == KERF_KIND_DEVICE) names.push_back({.scope = Scope::device, .name = all[i].id, .device = i});
    for (int f = 0; f < static_cast<int>(entry.component_count); ++f) {
        if (all[f].kind != KERF_KIND_FORCE) continue;
        const std::string law = std::string(" with ") + all[f].id;
        bool has_tool = false;
        for (int t = 0; t < static_cast<int>(entry.component_count); ++t) {
            if (all[t].kind != KERF_KIND_TOOL || !takes(all[f], all[t])) continue;
            names.push_back({Scope::law, all[t].id + law, t, f});
            has_tool = true;
        }
        if (!has_tool) names.push_back({Scope::law, "a stand-in" + law, -1, f});
    }
    return names;
}

Subject subject_of(std::shared_ptr<Plugin> plugin, const SubjectName& name) {
    Subject subject{std::move(plugin)};
    const kerf_component* all = subject.plugin->entry().components;
    if (name.force >= 0) subject.force = all + name.force;
    if (name.strategy >= 0) subject.strategy = all + name.strategy;
    if (name.device >= 0) subject.device = all + name.device;
    if (name.tool >= 0)
        subject.tool = all + name.tool;
    else if (name.force >= 0)
        subject.tool = &stand_in_for(*subject.force);
    return subject;
}

}  // namespace kerf::conformance
