// SPDX-License-Identifier: Apache-2.0
#include "run/view/recorded_scene.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "run/view/pointer_shape.h"
#include "run/view/scene_view.h"
#include "run/view/surface_shape.h"
#include "session/drawn_surface.h"
#include "text/palette.h"
#include "text/printable.h"

namespace kerf::run {

namespace {

double diameter_of(const session::RecordedProcedure& procedure, const std::string& instrument) {
    constexpr double thinnest = 0.5e-3, thickest = 30e-3;  // [m]
    for (const session::RecordedInstrument& one : procedure.instruments)
        if (one.id == instrument) return std::clamp(one.diameter.value_or(pointer_diameter), thinnest, thickest);
    return pointer_diameter;
}

/// Returns the index of the tool of an instrument, which is added if it is new.
std::size_t tool_of(const session::RecordedProcedure& procedure, const std::string& instrument, ViewedScene& scene) {
    const std::string name = instrument.empty() ? "tool" : text::printable(spaced(instrument));
    const auto found = std::ranges::find(scene.tools, name, &ViewedTool::name);
    if (found != scene.tools.end()) return static_cast<std::size_t>(found - scene.tools.begin());
    scene.tools.push_back({.name = name, .mesh = pointer_shape(diameter_of(procedure, instrument))});
    return scene.tools.size() - 1;
}

ViewedStep viewed_step(const session::RecordedStep& step) {
    ViewedStep viewed{.title = text::printable(step.title.empty() ? spaced(step.id) : step.title)};
    for (const session::RecordedDemand& goal : step.goals) {
        viewed.goals.push_back(viewed_demand(goal));
        if (goal.quantity == "depth") viewed.depth_goal = goal.at_least;
    }
    for (const session::RecordedDemand& limit : step.limits) {
        viewed.limits.push_back(viewed_demand(limit));
        if (limit.quantity == "depth") viewed.depth_limit = limit.at_most;
    }
    for (std::vector<ViewedLimit>* all : {&viewed.goals, &viewed.limits})
        for (ViewedLimit& one : *all) one.words = text::printable(one.words);
    return viewed;
}

}  // namespace

ViewedScene recorded_scene(const session::RecordedRun& run) {
    const session::RecordedProcedure& procedure = run.procedure;
    ViewedScene scene{.title = text::printable(procedure.title.empty() ? run.summary.procedure : procedure.title),
                      .mode = "record",
                      .hand = "recorded hand"};
    for (std::size_t t = 0; t < run.summary.tissues.size(); ++t) {
        const std::string& name = run.summary.tissues[t];
        const text::Colour colour = text::tissue_colour(name, t);
        scene.tissues.push_back({text::printable(spaced(name)), {colour.red, colour.green, colour.blue}});
    }
    for (const session::RecordedStep& step : procedure.steps) {
        scene.steps.push_back(viewed_step(step));
        scene.steps.back().tool = tool_of(procedure, step.instrument, scene);
    }
    if (scene.tools.empty()) static_cast<void>(tool_of(procedure, "", scene));
    return scene;
}

std::vector<ViewedZone> recorded_zones(const session::RunSummary& summary) {
    std::vector<ViewedZone> zones;
    for (const session::ZoneRow& zone : summary.zones)
        if (zones.size() < max_viewed_zones)
            zones.push_back({text::printable(spaced(zone.id)), viewed(session::unpacked(zone.surface))});
    return zones;
}

std::size_t index_of(const std::vector<session::RecordedDemand>& demands, const std::string& name) {
    return static_cast<std::size_t>(
        std::ranges::find_if(demands, [&](const session::RecordedDemand& one) { return one.name() == name; }) -
        demands.begin());
}

}  // namespace kerf::run
