// SPDX-License-Identifier: Apache-2.0
#include "run/run_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "documents/read_procedure.h"
#include "documents/waypoint_nodes.h"
#include "documents/yaml/document.h"
#include "documents/yaml/read_map.h"
#include "run/in_mm.h"
#include "run/span_in.h"
#include "text/codes.h"
#include "text/quantity.h"

namespace kerf::run {

namespace {

constexpr std::size_t max_tools = 8;

void check_device(const documents::Procedure& procedure, const documents::Document& document,
                  documents::Report& report) {
    if (procedure.device.empty() || find_device(procedure.device.c_str()) != nullptr) return;
    const std::vector<std::string> ids = device_ids();
    const documents::Node* haptics = document.root.find("haptics");
    const documents::Node* device = haptics != nullptr ? haptics->find("device") : nullptr;
    const std::string meant = documents::closest(procedure.device, ids);
    report.error(text::Code::unknown_device, device != nullptr ? device->span : documents::TextSpan{},
                 "The device is unknown: got `" + procedure.device + "`, expected " +
                     documents::listed(ids, procedure.device) + "." + documents::or_choose(meant),
                 meant);
}

/// Returns the span of a key of an instrument; of the instrument without that key.
documents::TextSpan span_of_instrument(const documents::Document& document, const std::string& id, const char* key) {
    const documents::Node* instruments = document.root.find("instruments");
    const documents::Node* instrument = instruments != nullptr ? instruments->find(id) : nullptr;
    const documents::Node* value = instrument != nullptr ? instrument->find(key) : nullptr;
    return value != nullptr ? value->span : instrument != nullptr ? instrument->span : documents::TextSpan{};
}

/// Returns the diameter of the narrowest cylindrical part of the hole [m]; without one, the largest diameter.
double narrowest_bore(const ToolSolid& turning) {
    const auto& outline = turning.outline();
    double radius = turning.largest_radius();
    for (std::size_t i = 0; i + 1 < outline.size(); ++i)
        if (outline[i].radius > 0.0 && outline[i].radius == outline[i + 1].radius)
            radius = std::min(radius, outline[i].radius);
    return 2.0 * radius;
}

/// Returns the waypoint of a step that is as far in front of the bone as `depth` is in it, between two that are nearer:
/// its sign slipped. Returns the size of the path if there is none.
std::size_t slipped_waypoint(const std::vector<documents::Waypoint>& path, std::size_t step, double depth) {
    for (std::size_t w = 1; w + 1 < path.size(); ++w) {
        const documents::Waypoint &before = path[w - 1], &here = path[w], &after = path[w + 1];
        const bool is_of_step = before.step == step && here.step == step && after.step == step;
        if (is_of_step && -here.depth >= depth && here.depth < before.depth && here.depth < after.depth) return w;
    }
    return path.size();
}

/// Warns of a rehearsal that expects to pass but is not led as deep as the goals of its steps.
void check_reach(const documents::Procedure& procedure, std::size_t rehearsal, const documents::Document& document,
                 documents::Report& report) {
    const documents::Rehearsal& r = procedure.rehearsals[rehearsal];
    if (r.expect != "pass") return;
    for (std::size_t s = 0; s < procedure.steps.size(); ++s) {
        double needed = -HUGE_VAL, deepest = -HUGE_VAL;
        for (const documents::Goal& goal : procedure.steps[s].goals)
            if (goal.quantity == "depth") needed = std::max(needed, goal.bound.at_least.value_or(needed));
        std::size_t where = 0;
        for (std::size_t w = 0; w < r.path.size(); ++w)
            if (r.path[w].step == s && r.path[w].depth > deepest) deepest = r.path[where = w].depth;
        if (deepest == -HUGE_VAL || deepest >= needed) continue;
        const std::size_t slipped = deepest <= 0.0 ? slipped_waypoint(r.path, s, needed) : r.path.size();
        if (slipped < r.path.size()) where = slipped;
        const documents::Node* depth = documents::waypoint_node(document, rehearsal, where, "depth");
        if (slipped < r.path.size()) {
            const double written = r.path[slipped].depth;
            report.warning(
                text::Code::short_of_goal,
                depth != nullptr ? depth->span : span_in(document, "rehearsals", rehearsal, "path"),
                "The waypoint lies in front of the bone, in a rehearsal that expects to pass: got a depth of " +
                    text::quantity_text(written, "mm") + ", and step `" + procedure.steps[s].id + "` needs at least " +
                    text::quantity_text(needed, "mm") + ". Did the sign slip?",
                text::quantity_text(-written, "mm"));
            continue;
        }
        report.warning(text::Code::short_of_goal,
                       depth != nullptr ? depth->span : span_in(document, "rehearsals", rehearsal, "path"),
                       "The path of a rehearsal that expects to pass is too shallow in step `" + procedure.steps[s].id +
                           "`: got " + text::quantity_text(deepest, "mm") + ", expected at least " +
                           text::quantity_text(needed, "mm") + ". Lead it deeper, or write how it is expected to fail.",
                       text::quantity_text(needed, "mm"));
    }
}

}  // namespace

void check_run(const documents::Procedure& procedure, text::Diagnostics& diagnostics) {
    const auto read = documents::document_of(procedure);
    const documents::Document& document = *read;
    documents::Report report(document, diagnostics);
    check_device(procedure, document, report);
    std::set<std::string> tools;
    for (std::size_t i = 0; i < procedure.steps.size(); ++i)
        if (tools.insert(procedure.steps[i].instrument).second && tools.size() == max_tools + 1)
            report.error(text::Code::too_many_tools, span_in(document, "steps", i, "instrument"),
                         "The steps use too many instruments: got " + std::to_string(tools.size()) +
                             ", expected at most " + std::to_string(max_tools) +
                             ". Use one of the others, or split the procedure in two.");
    for (std::size_t i = 0; i < procedure.rehearsals.size(); ++i) {
        const auto& path = procedure.rehearsals[i].path;
        if (path.empty()) continue;  // reported while it was read
        if (path.size() < 2)
            report.error(text::Code::path_too_short, span_in(document, "rehearsals", i, "path"),
                         "The rehearsal's path is too short: got " + std::to_string(path.size()) +
                             " waypoint, expected at least 2, a start and an end. Add one.");
        else if (path.front().depth >= 0.0)
            report.error(text::Code::starts_in_bone, span_in(document, "rehearsals", i, "path"),
                         "The rehearsal starts inside the bone: got a depth of " +
                             text::quantity_text(path.front().depth, "mm") + ", expected less than 0 mm.",
                         "[{depth: -5 mm}, …]");
        else if (!text::has_error(diagnostics))
            check_reach(procedure, i, document, report);
    }
}

void refuse_tool(const documents::Procedure& procedure, const std::string& instrument, const std::string& why,
                 text::Diagnostics& diagnostics) {
    const auto read = documents::document_of(procedure);
    const documents::Document& document = *read;
    const documents::Node* instruments = document.root.find("instruments");
    const documents::Node* node = instruments != nullptr ? instruments->find(instrument) : nullptr;
    const documents::Node* tool = node != nullptr ? node->find("tool") : nullptr;
    const documents::Node* plugin = node != nullptr ? node->find("plugin") : nullptr;
    const std::string component = tool != nullptr && plugin != nullptr ? plugin->text + "/" + tool->text : "";
    documents::Report(document, diagnostics)
        .error(text::Code::impossible_tool,
               tool != nullptr   ? tool->span
               : node != nullptr ? node->span
                                 : documents::TextSpan{},
               why + (component.empty() ? "" : " Change them: `kerf describe " + component + "` explains them."));
}

void report_strategy(const documents::Procedure& procedure, const std::string& instrument, const std::string& why,
                     text::Diagnostics& diagnostics) {
    const auto document = documents::document_of(procedure);
    documents::Report(*document, diagnostics)
        .error(text::Code::no_strategy, span_of_instrument(*document, instrument, "remeshing"),
               "The instrument `" + instrument + "` leaves no exact surface: " + why);
}

namespace {

/// Returns the width of a cut [m]: a saw's kerf, or the narrowest hole of a turning tool.
double width_of_cut(const ToolSolid& cutting) {
    return cutting.is_prism() ? cutting.thickness() : narrowest_bore(cutting);
}
double coarsest_for(const ToolSolid& cutting, double width) { return width / (cutting.is_prism() ? 2.0 : 4.0); }

}  // namespace

double coarsest_spacing(const ToolSolid& cutting) { return coarsest_for(cutting, width_of_cut(cutting)); }

void check_width_of_cut(const documents::Procedure& procedure, const std::string& instrument, const ToolSolid& cutting,
                        text::Diagnostics& diagnostics) {
    const double width = width_of_cut(cutting), coarsest = coarsest_for(cutting, width);
    if (procedure.spacing <= coarsest * (1.0 + 1e-9)) return;
    const auto document = documents::document_of(procedure);
    const documents::Node* accuracy = document->root.find("accuracy");
    const documents::Node* spacing = accuracy != nullptr ? accuracy->find("spacing") : nullptr;
    const std::string voxels = " voxels of " + in_mm(procedure.spacing) + ". ",
                      needed = in_mm(std::floor(coarsest / 0.01e-3 + 1e-6) * 0.01e-3);
    const std::string what =
        cutting.is_prism() ? "The saw's kerf is too narrow for the spacing: got " + in_mm(width) +
                                 ", expected at least two" + voxels + "The slot is lost between samples."
                           : "The hole of `" + instrument + "` is too narrow for the spacing: got " + in_mm(width) +
                                 ", expected at least four" + voxels +
                                 "The position of its wall is uncertain, and the tool meets bone that it has cut.";
    documents::Report(*document, diagnostics)
        .warning(cutting.is_prism() ? text::Code::narrow_kerf : text::Code::narrow_hole,
                 spacing != nullptr ? spacing->span : span_of_instrument(*document, instrument, "tool"),
                 what + " Use a spacing of " + needed + " or less.", needed);
}

void check_guide(const documents::Procedure& procedure, const documents::Instrument& instrument, const ToolSolid& whole,
                 text::Diagnostics& diagnostics) {
    if (!instrument.guide) return;
    const documents::Sleeve& sleeve = *instrument.guide;
    const auto document = documents::document_of(procedure);
    documents::Report report(*document, diagnostics);
    const documents::TextSpan here = span_of_instrument(*document, instrument.id, "guide");
    const documents::Node* bore = &document->root;
    for (const std::string& key :
         {std::string("instruments"), instrument.id, std::string("guide"), std::string("bore")})
        bore = bore != nullptr ? bore->find(key) : nullptr;
    const double width = 2.0 * whole.largest_radius(), length = -whole.end_z();
    if (whole.is_prism())
        return report.error(text::Code::narrow_guide, here,
                            "The instrument `" + instrument.id +
                                "` has a sleeve: got a blade, expected a turning tool. Remove `guide:`.");
    if (width >= sleeve.bore)
        return report.error(text::Code::narrow_guide, bore != nullptr ? bore->span : here,
                            "The sleeve's bore is too narrow: got " + in_mm(sleeve.bore) + ", expected more than " +
                                in_mm(width) + ", the width of the tool. Write a wider `bore:`.");
    const double reach = std::max(0.0, length - sleeve.length - sleeve.gap);
    for (const documents::Step& step : procedure.steps)
        for (const documents::Goal& goal : step.goals) {
            const double asked = goal.quantity == "depth" ? goal.bound.at_least.value_or(0.0) : 0.0;
            if (step.instrument != instrument.id || asked <= reach) continue;
            const text::ComparedTexts depths = compared_in_mm(reach, asked);
            return report.warning(text::Code::short_of_sleeve, here,
                                  "The tool of " + in_mm(length) + " is too short for its sleeve in step `" + step.id +
                                      "`: got a depth of " + depths.value + ", expected at least " + depths.bound +
                                      ". Write a shorter `length:`, or take a longer tool.");
        }
}

void check_hole_limits(const documents::Procedure& procedure, std::size_t step, const ToolSolid& cutting,
                       text::Diagnostics& diagnostics) {
    if (!cutting.is_prism()) return;
    const documents::Step& asked = procedure.steps[step];
    const auto document = documents::document_of(procedure);
    const documents::Node* steps = document->root.find("steps");
    const documents::Node* item = steps != nullptr && step < steps->children.size() ? &steps->children[step] : nullptr;
    const documents::Node* limits = item != nullptr ? item->find("limits") : nullptr;
    for (std::size_t l = 0; l < asked.limits.size(); ++l) {
        const documents::Limit& limit = asked.limits[l];
        if (!limit.is_of_hole()) continue;
        const documents::Node* written =
            limits != nullptr && l < limits->children.size() ? limits->children[l].find(limit.quantity) : nullptr;
        documents::Report(*document, diagnostics)
            .error(text::Code::needs_hole, written != nullptr ? written->key_span : documents::TextSpan{},
                   "The limit `" + limit.quantity + "` needs a drilled hole: got the blade `" + asked.instrument +
                       "`, expected a turning tool. Use a limit of a cut, or an instrument that drills.");
    }
}

void check_turns(const documents::Procedure& procedure, std::size_t step, bool has_thread,
                 text::Diagnostics& diagnostics) {
    if (has_thread) return;
    const auto document = documents::document_of(procedure);
    for (std::size_t r = 0; r < procedure.rehearsals.size(); ++r)
        for (std::size_t w = 0; w < procedure.rehearsals[r].path.size(); ++w) {
            const documents::Waypoint& waypoint = procedure.rehearsals[r].path[w];
            if (waypoint.step != step || (waypoint.turn == 0.0 && waypoint.regrip <= 0.0)) continue;
            const documents::Node* turn = documents::waypoint_node(*document, r, w, "turn");
            documents::Report(*document, diagnostics)
                .error(text::Code::needs_driver, turn != nullptr ? turn->key_span : documents::TextSpan{},
                       "The hand cannot turn `" + procedure.steps[step].instrument +
                           "`: got a tool without a thread, expected a screw or a tap. Remove `turn:`.");
        }
}

void check_force_scale(const documents::Procedure& procedure, const DeviceRecord& device, double work_force,
                       text::Diagnostics& diagnostics) {
    if (work_force > 0.0 || procedure.force_scale || procedure.working_force) return;
    const auto document = documents::document_of(procedure);
    const documents::Node* haptics = document->root.find("haptics");
    const documents::Node* instruments = document->root.find("instruments");
    documents::Report(*document, diagnostics)
        .warning(text::Code::no_force_scale,
                 haptics != nullptr       ? haptics->span
                 : instruments != nullptr ? instruments->span
                                          : documents::TextSpan{},
                 "No force scale can be computed: no tool cuts with its drives and coefficients. The scale is 1/1, at "
                 "which the device renders at most " +
                     text::quantity_text(device.peak_force, "N") +
                     ". For a pushed tool, write `working_force:` under `haptics:`, such as 100 N, or `force_scale:`.");
}

void check_felt(const documents::Procedure& procedure, std::size_t step, const std::vector<double>& along,
                const DeviceRecord& device, double force_scale, text::Diagnostics& diagnostics) {
    if (std::none_of(along.begin(), along.end(), [](double force) { return force > 0.0; })) return;
    const auto hidden =
        std::count_if(along.begin(), along.end(), [&](double f) { return f * force_scale < device.friction; });
    if (2 * static_cast<std::size_t>(hidden) <= along.size()) return;
    const auto document = documents::document_of(procedure);
    const documents::Node* haptics = document->root.find("haptics");
    const long percent = std::lround(100.0 * static_cast<double>(hidden) / static_cast<double>(along.size()));
    documents::Report(*document, diagnostics)
        .warning(
            text::Code::felt_below_friction,
            haptics != nullptr ? haptics->span : span_in(*document, "steps", step, "instrument"),
            "Most of step `" + procedure.steps[step].id + "` cannot be felt on `" + std::string(device.id) +
                "`: over " + std::to_string(percent) + " % of its path, bone resists with less than " +
                text::quantity_text(std::round(device.friction / force_scale * 10.0) * 0.1, "N") +
                ". At the force scale of 1/" + std::to_string(std::lround(1.0 / force_scale)) +
                ", that is less than the device's friction of " + text::quantity_text(device.friction, "N") +
                (procedure.force_scale ? ". Write a larger `force_scale:`" : ". Write a smaller `working_force:`") +
                ", or take a device with less friction.");
}

void check_time(const documents::Procedure& procedure, std::size_t rehearsal, double min_time,
                text::Diagnostics& diagnostics) {
    const documents::Rehearsal& r = procedure.rehearsals[rehearsal];
    if (r.expect != "pass" || min_time <= procedure.time_limit) return;
    const auto document = documents::document_of(procedure);
    const documents::Node* limit = document->root.find("time_limit");
    const std::string needed = text::quantity_text(std::ceil(min_time), "s");
    documents::Report(*document, diagnostics)
        .warning(text::Code::short_of_time,
                 limit != nullptr ? limit->span : span_in(*document, "rehearsals", rehearsal, "path"),
                 "The time limit is too short for `" + r.id + "`, which expects to pass: got " +
                     text::quantity_text(procedure.time_limit, "s") + ", expected at least " + needed +
                     " for its path at its approach and feed. Write a longer `time_limit:`, or a faster hand.",
                 needed);
}

void check_blade_fits(const documents::Procedure& procedure, const std::string& instrument, const ToolSolid& cutting,
                      const Region& region, text::Diagnostics& diagnostics) {
    if (!cutting.is_prism() || !region.is_bounded()) return;
    const Vec3 size = region.high - region.low;
    const double least = std::min({size.x, size.y, size.z}), most = std::max({size.x, size.y, size.z}),
                 width = 2.0 * cutting.largest_radius();
    const bool is_thick = cutting.thickness() >= least;
    if (!is_thick && width < most) return;
    const text::ComparedTexts shown = compared_in_mm(is_thick ? cutting.thickness() : width, is_thick ? least : most);
    const auto document = documents::document_of(procedure);
    documents::Report(*document, diagnostics)
        .error(text::Code::blade_beyond_region, span_of_instrument(*document, instrument, "tool"),
               std::string("The blade is too ") + (is_thick ? "thick" : "wide") +
                   " for the region in which bone can be cut: got " + shown.value + ", expected less than " +
                   shown.bound + " of " + in_mm(size.x) + " × " + in_mm(size.y) + " × " + in_mm(size.z) +
                   ". Take a smaller blade, or plan the axis so that the region is larger.");
}

namespace {

/// Returns how far the solid reaches into bone beyond the region [m]. The bone there is assumed to be as on the nearest
/// face of the region.
double reach_beyond(const Body& body, const ToolSolid& cutting, const Pose& body_from_tool) {
    double farthest = 0.0;
    cutting.for_each_ring(body.grid().spacing, [&](const std::array<Vec3, 8>& ring) {
        for (const Vec3 point : ring) {
            const Vec3 p = body_from_tool * point;
            const double beyond = body.region.distance_outside(p);
            if (beyond > farthest && uncut_distance(body, locate(body.grid(), body.region.nearest(p))) < 0.0)
                farthest = beyond;
        }
    });
    return farthest;
}

}  // namespace

void check_waypoints_in_region(const documents::Procedure& procedure, const std::vector<AxisFrame>& frames,
                               const std::vector<const ToolSolid*>& cutting, const Body& body,
                               text::Diagnostics& diagnostics) {
    if (!body.region.is_bounded()) return;
    const auto document = documents::document_of(procedure);
    documents::Report report(*document, diagnostics);
    for (std::size_t r = 0; r < procedure.rehearsals.size(); ++r)
        for (std::size_t w = 0; w < procedure.rehearsals[r].path.size(); ++w) {
            const documents::Waypoint& waypoint = procedure.rehearsals[r].path[w];
            if (!procedure.steps[waypoint.step].cuts()) continue;  // the held piece was separated before
            const double beyond = reach_beyond(body, *cutting[waypoint.step], frames[waypoint.step].pose_at(waypoint));
            if (beyond < body.grid().spacing) continue;
            const Vec3 size = body.region.high - body.region.low;
            const text::ComparedTexts shown = compared_in_mm(beyond, body.grid().spacing);
            const documents::Node* where = documents::waypoint_node(*document, r, w);
            report.warning(
                text::Code::waypoint_beyond_region, where != nullptr ? where->span : documents::TextSpan{},
                "Here `" + procedure.steps[waypoint.step].instrument +
                    "` leaves the region in which bone can be cut: got " + shown.value +
                    " beyond it, expected less than " + shown.bound + ". Beyond its " + in_mm(size.x) + " × " +
                    in_mm(size.y) + " × " + in_mm(size.z) +
                    " around the planned axes, bone acts as a wall that stops the hand. Stay within, or give "
                    "the anatomy an axis that leads as far.");
        }
}

}  // namespace kerf::run
