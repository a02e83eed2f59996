// SPDX-License-Identifier: Apache-2.0
#include "run/view/scene_view.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

#include "core/plugin/unit.h"
#include "run/view/body_shape.h"
#include "run/view/tool_shape.h"
#include "run/view/zone_shape.h"
#include "text/palette.h"
#include "text/quantity.h"

namespace kerf::run {

namespace {

/// A quantity of goals and limits, in words and with its unit for people.
struct Quantity {
    std::string_view id, words, unit;
};
constexpr std::array quantities{Quantity{"entry", "reach the bone", ""},
                                Quantity{"separated", "separate the bone", ""},
                                Quantity{"held", "hold the piece", ""},
                                Quantity{"moved", "move the piece", "mm"},
                                Quantity{"depth", "depth", "mm"},
                                Quantity{"removed_volume", "bone removed", "mm3"},
                                Quantity{"thrust", "thrust", "N"},
                                Quantity{"torque", "torque", "N m"},
                                Quantity{"lateral_force", "force across the shaft", "N"},
                                Quantity{"speed", "speed in bone", "mm/s"},
                                Quantity{"duration", "duration", "s"},
                                Quantity{"time_in_air", "time in air", "s"},
                                Quantity{"plunge", "plunge", "mm"},
                                Quantity{"plane_angle", "angle to the plane", "deg"},
                                Quantity{"plane_offset", "distance from the plane", "mm"},
                                Quantity{"flatness", "unevenness", "mm"},
                                Quantity{"hole_angle", "angle of the hole", "deg"},
                                Quantity{"entry_offset", "hole off at its entry", "mm"},
                                Quantity{"narrowest_offset", "hole off where bone is narrowest", "mm"},
                                Quantity{"end_offset", "hole off at its end", "mm"},
                                Quantity{"breach", "breach", "mm"},
                                Quantity{"excess_removal", "bone beyond the planned hole", "%"},
                                Quantity{"reduction_offset", "fragment off", "mm"},
                                Quantity{"reduction_angle", "fragment turned by", "deg"},
                                Quantity{"axes_angle", "angle of the axes", "deg"},
                                Quantity{"tip_apex", "tip-apex distance", "mm"}};

/// Returns "depth at least 30 mm and at most 40 mm".
std::string bound_in_words(std::string name, const documents::Bound& bound, const std::string& unit) {
    if (bound.at_least) name += " at least " + text::quantity_text(*bound.at_least, unit);
    if (bound.at_least && bound.at_most) name += " and";
    if (bound.at_most) name += " at most " + text::quantity_text(*bound.at_most, unit);
    return name;
}

/// Completes a limit whose quantity is set.
/// @param name  of the quantity, for people
ViewedLimit with_bound(ViewedLimit limit, std::string name, const documents::Bound& bound) {
    limit.per_unit = parse_unit(limit.unit).value_or(Unit{}).factor;
    limit.at_least = bound.at_least;
    limit.at_most = bound.at_most;
    limit.words = bound_in_words(std::move(name), bound, limit.unit);
    return limit;
}

std::string unit_of_measure(const documents::Procedure& procedure, const std::string& id) {
    for (const documents::Measure& measure : procedure.measures)
        if (measure.id == id) return measure.unit();
    return {};
}

/// Completes a limit on a quantity of the table, or on another one by its id.
ViewedLimit of_quantity(ViewedLimit limit, const documents::Bound& bound) {
    std::string name = spaced(limit.quantity);
    for (const Quantity& one : quantities) {
        if (one.id != limit.quantity) continue;
        limit.unit = one.unit;
        name = one.words;
    }
    return with_bound(std::move(limit), std::move(name), bound);
}

ViewedLimit of_clearance(const std::string& zone, const documents::Bound& bound) {
    return with_bound({.quantity = zone, .unit = "mm"}, "distance to " + spaced(zone), bound);
}

/// Returns a goal or limit on a quantity of the table, a signal or a measure.
template <class Demand>
ViewedLimit viewed(const Demand& demand, const documents::Procedure& procedure) {
    ViewedLimit limit{.quantity = demand.quantity};
    if (!demand.signal.id.empty()) {
        limit.unit = demand.signal.unit;
        return with_bound(std::move(limit), spaced(demand.signal.id), demand.bound);
    }
    if (!demand.measure.empty()) {
        limit.unit = unit_of_measure(procedure, demand.measure);
        return with_bound(std::move(limit), spaced(demand.measure), demand.bound);
    }
    return of_quantity(std::move(limit), demand.bound);
}

ViewedStep viewed_step(const Scene& scene, std::size_t number, const std::string& language) {
    const documents::Step& step = scene.procedure.steps[number];
    const AxisFrame& frame = scene.frames[number];
    const documents::Translations& translations = scene.procedure.translations;
    ViewedStep viewed{.title = translations.of(step.title, language),
                      .hint = translations.of(step.hint, language),
                      .tool = scene.tool_of_step[number]};
    for (const documents::Goal& goal : step.goals) {
        viewed.goals.push_back(viewed_goal(goal, scene.procedure));
        if (goal.quantity == "depth" && goal.bound.at_least) viewed.depth_goal = goal.bound.at_least;
    }
    for (const documents::Limit& limit : step.limits) {
        viewed.limits.push_back(viewed_limit(limit, scene.procedure));
        if (limit.quantity == "depth" && limit.bound.at_most) viewed.depth_limit = limit.bound.at_most;
    }
    viewed.entry = frame.entry;
    viewed.along = frame.along;
    constexpr double without_goal = 20e-3;
    viewed.length = viewed.depth_goal.value_or(without_goal);
    if (length(frame.across) > 0.5) viewed.plane_normal = frame.across;
    return viewed;
}

/// A zone of a tissue lies in bone: it is drawn only if a step has a limit on it.
bool is_drawn(const documents::Zone& zone, const documents::Procedure& procedure) {
    const auto is_limited = [&](const documents::Step& step) {
        return std::any_of(step.limits.begin(), step.limits.end(),
                           [&](const documents::Limit& limit) { return limit.zone == zone.id; });
    };
    return !zone.is_tissue || std::any_of(procedure.steps.begin(), procedure.steps.end(), is_limited);
}

ViewedTool::Lead lead_of(const Tool& tool) {
    using Lead = ViewedTool::Lead;
    if (tool.outline.whole.is_prism()) return Lead::in_blade;
    return tool.setup.tool->tool->feed == KERF_FEED_SIDE ? Lead::facing : Lead::across;
}

/// Removes all that a trainee must know without help.
void hide_help(ViewedScene& viewed) {
    viewed.zones.clear();
    for (ViewedStep& step : viewed.steps) {
        step.hint.clear();
        step.limits.clear();
        step.depth_limit.reset();
        step.length = 0.0;
        step.plane_normal.reset();
    }
}

ViewedZone viewed_zone(const documents::Zone& zone, const Scene& scene) {
    ViewedZone viewed{.name = spaced(zone.id)};
    const bool is_hidden = display_of(zone, scene.procedure).show == documents::ZoneDisplay::Show::never;
    if (!is_hidden && is_drawn(zone, scene.procedure)) viewed.mesh = zone_shape(zone, scene.procedure.spacing);
    return viewed;
}

std::vector<ViewedSignal> signals_of(const Tool& tool) {
    const kerf_force& law = *tool.setup.force->force;
    std::vector<ViewedSignal> signals;
    for (std::uint32_t i = 0; i < law.signal_count; ++i) {
        const std::string unit = law.signals[i].display_unit;
        signals.push_back({spaced(law.signals[i].id), unit, parse_unit(unit).value_or(Unit{}).factor});
    }
    return signals;
}

std::string name_of(const Scene& scene, std::size_t tool) {
    const documents::Instrument& instrument = instrument_of(scene, tool);
    return spaced(instrument.id);
}

}  // namespace

std::string spaced(std::string text) {
    std::replace(text.begin(), text.end(), '_', ' ');
    std::replace(text.begin(), text.end(), '-', ' ');
    return text;
}

documents::ZoneDisplay display_of(const documents::Zone& zone, const documents::Procedure& procedure) {
    for (const documents::ZoneDisplay& display : procedure.zones)
        if (display.zone == zone.id) return display;
    return {.zone = zone.id};
}

ViewedLimit viewed_goal(const documents::Goal& goal, const documents::Procedure& procedure) {
    return viewed(goal, procedure);
}

ViewedLimit viewed_limit(const documents::Limit& limit, const documents::Procedure& procedure) {
    if (limit.quantity == "clearance") return of_clearance(limit.zone, limit.bound);
    if (limit.quantity == "damage")
        return {.words = "no damage: " + spaced(limit.event.substr(limit.event.find('.') + 1)),
                .quantity = limit.event};
    return viewed(limit, procedure);
}

ViewedLimit viewed_demand(const session::RecordedDemand& demand) {
    const documents::Bound bound{demand.at_least, demand.at_most};
    if (demand.quantity == "clearance") return of_clearance(demand.of, bound);
    if (demand.of.empty()) return of_quantity({.quantity = demand.quantity}, bound);
    return with_bound({.quantity = demand.quantity, .unit = demand.unit}, spaced(demand.of), bound);
}

std::vector<ViewedTissue> viewed_tissues(const Body& body) {
    std::vector<ViewedTissue> tissues;
    for (std::size_t m = 0; m < body.materials.size(); ++m) {
        const std::string& name = body.materials[m].id;
        const text::Colour colour = text::tissue_colour(name, m);
        tissues.push_back({spaced(name), {colour.red, colour.green, colour.blue}});
    }
    return tissues;
}

ViewedScene viewed_scene(const Scene& scene, const ViewedSetting& setting) {
    ViewedScene viewed{.title = scene.procedure.translations.of(scene.procedure.title, setting.language),
                       .mode = setting.mode,
                       .repeated = setting.repeated,
                       .hand = setting.hand};
    viewed.tissues = viewed_tissues(scene.body);
    for (std::size_t t = 0; t < scene.tools.size(); ++t) {
        const ToolOutline& outline = scene.tools[t].outline;
        viewed.tools.push_back({.name = name_of(scene, t),
                                .mesh = tool_shape(scene.tools[t]),
                                .staying = outline.is_implant() ? staying_shape(scene.tools[t]) : ViewedMesh{},
                                .is_implant = outline.is_implant(),
                                .lead_by = lead_of(scene.tools[t]),
                                .lead = outline.thread_lead,
                                .law = scene.tools[t].setup.force->id,
                                .signals = signals_of(scene.tools[t])});
    }
    for (const Body& implant : scene.implants) viewed.implants.push_back(body_shape(implant));
    for (const documents::Zone& zone : scene.anatomy.zones) viewed.zones.push_back(viewed_zone(zone, scene));
    for (std::size_t s = 0; s < scene.procedure.steps.size(); ++s)
        viewed.steps.push_back(viewed_step(scene, s, setting.language));
    viewed.is_examination = viewed.mode == "exam";
    viewed.assist = viewed.is_examination ? ViewedScene::Assist::off
                                          : static_cast<ViewedScene::Assist>(static_cast<int>(setting.assist));
    if (viewed.assist == ViewedScene::Assist::off) hide_help(viewed);
    viewed.spacing = scene.procedure.spacing;
    viewed.time_limit = scene.procedure.time_limit;
    return viewed;
}

}  // namespace kerf::run
