// SPDX-License-Identifier: Apache-2.0
#include "run/thread_checks.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "documents/read_procedure.h"
#include "documents/waypoint_nodes.h"
#include "documents/yaml/document.h"
#include "documents/yaml/read_map.h"
#include "run/in_mm.h"
#include "text/codes.h"
#include "text/quantity.h"

namespace kerf::run {

namespace {

/// Reports errors about one step of a procedure.
class StepReport {
public:
    StepReport(const documents::Procedure& procedure, std::size_t step, text::Diagnostics& diagnostics)
        : document_(documents::document_of(procedure)), step_(step), report_(*document_, diagnostics) {}

    /// Reports an error at one of the step's keys, or at the step if it lacks the key.
    void error(text::Code code, const char* key, const std::string& text) {
        const documents::Node* steps = document_->root.find("steps");
        const documents::Node* item =
            steps != nullptr && step_ < steps->children.size() ? &steps->children[step_] : nullptr;
        const documents::Node* value = item != nullptr ? item->find(key) : nullptr;
        report_.error(code,
                      value != nullptr  ? value->span
                      : item != nullptr ? item->span
                                        : documents::TextSpan{},
                      text);
    }

private:
    std::shared_ptr<const documents::Document> document_;
    std::size_t step_;
    documents::Report report_;
};

double seat_of(const ToolOutline& tool) noexcept { return -tool.cutting.end_z(); }

/// Returns the radius of a screw behind its tip's cone.
double tip_core(const ToolOutline& tool) noexcept {
    return tool.profile[std::min<std::size_t>(1, tool.cutting_count - 1)].radius;
}

/// Returns the depth of the step's goal; −∞ without one.
double goal_depth(const documents::Step& step) noexcept {
    double depth = -HUGE_VAL;
    for (const documents::Goal& goal : step.goals)
        if (goal.quantity == "depth") depth = std::max(depth, goal.bound.at_least.value_or(depth));
    return depth;
}

/// Refuses releases and insertions of tools that are no implant.
void check_releases(const documents::Procedure& procedure, const std::vector<const ToolOutline*>& tools,
                    text::Diagnostics& diagnostics) {
    const auto document = documents::document_of(procedure);
    documents::Report report(*document, diagnostics);
    const auto is_implant = [&](std::size_t step) { return tools[step]->is_implant(); };
    for (const documents::Instrument& instrument : procedure.instruments) {
        const auto user = std::find_if(procedure.steps.begin(), procedure.steps.end(),
                                       [&](const documents::Step& step) { return step.instrument == instrument.id; });
        if (!instrument.is_inserted || user == procedure.steps.end() ||
            is_implant(static_cast<std::size_t>(user - procedure.steps.begin())))
            continue;
        const documents::Node* instruments = document->root.find("instruments");
        const documents::Node* written = instruments != nullptr ? instruments->find(instrument.id) : nullptr;
        const documents::Node* key = written != nullptr ? written->find("remeshing") : nullptr;
        report.error(text::Code::needs_implant, key != nullptr ? key->span : documents::TextSpan{},
                     "`" + instrument.id + "` is no implant, so it does not stay. Remove `remeshing: insert`.");
    }
    for (std::size_t r = 0; r < procedure.rehearsals.size(); ++r)
        for (std::size_t w = 0; w < procedure.rehearsals[r].path.size(); ++w) {
            const documents::Waypoint& waypoint = procedure.rehearsals[r].path[w];
            const bool is_released = std::any_of(
                waypoint.inputs.begin(), waypoint.inputs.end(),
                [](const documents::HandInput& i) { return i.kind == documents::HandInput::Kind::release; });
            if (!is_released || is_implant(waypoint.step)) continue;
            const documents::Node* node = documents::waypoint_node(*document, r, w, "do");
            report.error(text::Code::needs_implant, node != nullptr ? node->span : documents::TextSpan{},
                         "`" + procedure.steps[waypoint.step].instrument +
                             "` is no implant, so it is not released. Remove `do: release`.");
        }
}

/// The widest radii of holes and taps made along a step's axis before it [m].
struct EarlierBores {
    double hole = 0.0, tap = 0.0;
};
/// Returns the largest cutting radius within `behind` [m] of the tip: the radius of the hole at that height above its
/// bottom [m].
double radius_behind(const ToolOutline& tool, double behind) noexcept {
    double widest = 0.0;
    for (std::size_t i = 0; i < tool.cutting_count; ++i) {
        const kerf_profile_point& end = tool.profile[i];
        if (-end.z <= behind) {
            widest = std::max(widest, end.radius);
        } else if (i > 0) {
            const kerf_profile_point& from = tool.profile[i - 1];
            const double share = (behind + from.z) / (from.z - end.z);
            return std::max(widest, from.radius + share * (end.radius - from.radius));
        }
    }
    return widest;
}

/// Returns the length of the cone at the tip [m].
double point_of(const ToolOutline& tool) noexcept { return tool.cutting_count > 1 ? -tool.profile[1].z : 0.0; }

/// Returns the hole and the tap before a step. An opening of the cortex alone is no hole for the thread. So the width
/// counts at half the thread's depth.
EarlierBores before_step(const documents::Procedure& procedure, const std::vector<const ToolOutline*>& tools,
                         std::size_t step) {
    EarlierBores found;
    for (std::size_t b = 0; b < step; ++b) {
        const ToolOutline& tool = *tools[b];
        if (procedure.steps[b].axis != procedure.steps[step].axis || tool.cutting_count == 0) continue;
        if (tool.has_thread() && !tool.is_implant()) found.tap = std::max(found.tap, tool.thread_radius);
        if (tool.has_thread() || tool.cutting.is_prism()) continue;
        const double depth = goal_depth(procedure.steps[b]), half = 0.5 * goal_depth(procedure.steps[step]);
        if (depth == -HUGE_VAL || half == -HUGE_VAL)
            found.hole = std::max(found.hole, tool.cutting.largest_radius());
        else if (depth >= half)
            found.hole = std::max(found.hole, radius_behind(tool, std::max(depth - half, point_of(tool))));
    }
    return found;
}

void check_lead(const documents::Procedure& procedure, const std::vector<const ToolOutline*>& tools, std::size_t step,
                StepReport& report) {
    constexpr double same = 0.02;  // [–] same as in the law of the screw
    for (std::size_t b = 0; b < step; ++b) {
        const documents::Step &before = procedure.steps[b], &now = procedure.steps[step];
        if (before.axis != now.axis || !tools[b]->has_thread() || tools[b]->is_implant()) continue;
        const double lead = tools[step]->thread_lead, cut = tools[b]->thread_lead;
        if (std::abs(cut - lead) <= same * lead) continue;
        report.error(text::Code::other_lead, "instrument",
                     "`" + now.instrument + "` goes " + in_mm(lead) + " in a turn, and `" + before.instrument +
                         "`, which cuts its thread in step `" + before.id + "`, " + in_mm(cut) +
                         ". Give both the same `pitch` and `starts`.");
    }
}

}  // namespace

void check_threads(const documents::Procedure& procedure, const std::vector<const ToolOutline*>& tools,
                   text::Diagnostics& diagnostics) {
    check_releases(procedure, tools, diagnostics);
    for (std::size_t s = 0; s < procedure.steps.size(); ++s) {
        const documents::Step& step = procedure.steps[s];
        const ToolOutline& tool = *tools[s];
        if (!tool.has_thread()) continue;
        StepReport report(procedure, s, diagnostics);
        check_lead(procedure, tools, s, report);
        const EarlierBores before = before_step(procedure, tools, s);
        const double thread = tool.thread_radius, tip = tip_core(tool);
        constexpr double hair = 0.05e-3;  // [m]
        const std::string wide =
            "The thread of `" + step.instrument + "` is " + in_mm(2.0 * thread) + " wide, and its ";
        if (tool.is_implant() && before.tap > thread + hair)
            report.error(text::Code::hole_too_wide, "instrument",
                         wide + "tap " + in_mm(2.0 * before.tap) + ". Take a thinner tap, or a thicker screw.");
        if (before.hole >= thread)
            report.error(text::Code::hole_too_wide, "instrument",
                         wide + "hole along `" + step.axis + "` " + in_mm(2.0 * before.hole) +
                             ". Take a thinner drill, or a thicker screw.");
        if (before.hole > 0.0 && tip > before.hole + hair)
            report.error(text::Code::core_too_wide, "instrument",
                         "The tip of `" + step.instrument + "` has a core of " + in_mm(2.0 * tip) +
                             ", and the hole along `" + step.axis + "` is " + in_mm(2.0 * before.hole) +
                             " wide. Take a wider drill, or a screw with a core of at most " +
                             in_mm(2.0 * before.hole) + ".");
        if (const double asked = goal_depth(step); tool.is_implant() && asked > seat_of(tool)) {
            const text::ComparedTexts depths = compared_in_mm(asked, seat_of(tool));
            report.error(text::Code::seats_too_soon, "goals",
                         "The goal is a depth of at least " + depths.value + ", and the head of `" + step.instrument +
                             "` seats at " + depths.bound + ". Take a longer one, or ask for no more.");
        }
    }
}

namespace {

/// Returns whether the axis reaches its entry through a hole of the bone, with bone around it.
bool enters_through_hole(const AxisFrame& frame, double radius, const Body& body) {
    constexpr int around = 16;
    constexpr double before = 2e-3;  // [m]
    const Quat turn = quat_between({0, 0, 1}, frame.along);
    int in_bone = 0;
    for (int i = 0; i < around; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / around;
        const Vec3 beside = rotate(turn, {radius * std::cos(angle), radius * std::sin(angle), -before});
        in_bone += uncut_distance(body, locate(body, frame.entry + beside)) < 0.0;
    }
    return in_bone > around / 2;
}

/// Where the bone around an axis is narrowest.
struct Waist {
    double width = HUGE_VAL;  ///< [m] through the axis
    double depth = 0.0;       ///< [m]
};

/// Returns the narrowest bone around an axis between two depths, if it is narrower than `limit` [m].
Waist waist_of(const AxisFrame& frame, const Body& body, double from, double to, double limit) {
    constexpr int directions = 16;
    constexpr double step_along = 0.5e-3;  // [m]
    const double step = 0.25 * body.grid().spacing;
    const Vec3 side = normalized(cross(frame.along, std::abs(frame.along.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0}));
    const Vec3 up = cross(frame.along, side);
    Waist waist;
    for (double depth = from; depth <= to; depth += step_along) {
        const Vec3 at = frame.entry + depth * frame.along;
        if (uncut_distance(body, locate(body, at)) >= 0.0) continue;  // a gap on the axis has no width
        for (int n = 0; n < directions; ++n) {
            const double angle = n * std::numbers::pi / directions;
            const Vec3 across = std::cos(angle) * side + std::sin(angle) * up;
            const auto reach = [&](double sign) {
                double far = 0.0;
                while (far < limit && uncut_distance(body, locate(body, at + sign * far * across)) < 0.0) far += step;
                return far;
            };
            if (const double width = reach(1.0) + reach(-1.0); width < limit && width < waist.width)
                waist = {width, depth};
        }
    }
    return waist;
}

/// Refuses a screw whose thread is wider than the bone around it, away from the surfaces at both ends.
void check_room(const documents::Step& step, const ToolOutline& tool, const AxisFrame& frame, const Body& body,
                double end, StepReport& report) {
    const double thread = 2.0 * tool.thread_radius;
    const Waist waist = waist_of(frame, body, thread, end - thread, thread);
    const text::ComparedTexts shown = compared_in_mm(thread, waist.width);
    if (waist.width < thread)
        report.error(text::Code::screw_too_wide, "instrument",
                     "The thread of `" + step.instrument + "` is wider than the bone along `" + step.axis + "`: got " +
                         shown.value + ", expected at most " + shown.bound + ", the width " + in_mm(waist.depth) +
                         " deep. Take a thinner screw, or another anatomy.");
}

}  // namespace

void check_screw_in_bone(const documents::Procedure& procedure, const std::vector<const ToolOutline*>& tools,
                         std::size_t step, const AxisFrame& frame, const Body& body, text::Diagnostics& diagnostics) {
    const ToolOutline& tool = *tools[step];
    const documents::Step& planned = procedure.steps[step];
    if (!tool.has_thread()) return;
    StepReport report(procedure, step, diagnostics);
    const bool is_in_a_hole = enters_through_hole(frame, tool.thread_radius, body);
    if (before_step(procedure, tools, step).hole <= 0.0 && !is_in_a_hole)
        report.error(text::Code::no_hole, "instrument",
                     "`" + planned.instrument + "` has a thread, and no step before `" + planned.id +
                         "` drills a hole for it along `" + planned.axis +
                         "`. Put one before it, with a drill about as wide as its core, " +
                         in_mm(2.0 * tip_core(tool)) + ".");
    if (!tool.is_implant() || is_in_a_hole) return;  // the entry is at the bottom of a hole
    // The head seats on the metal around its hole. The far side of the metal is on the bone.
    const double metal = frame.plate ? std::max(0.0, -2.0 * *frame.plate) : 0.0;
    const double seat = seat_of(tool) - metal, spacing = body.grid().spacing;
    double last = 0.0;  // [m] of bone along the axis
    for (double depth = 0.0; depth <= seat + spacing; depth += spacing)
        if (uncut_distance(body, locate(body, frame.entry + depth * frame.along)) < 0.0) last = depth;
    check_room(planned, tool, frame, body, std::min(seat, last), report);
    // [m] accepted protrusion of a tip that is planned to leave the far side [judgement].
    constexpr double proud = 15e-3;
    if (last + spacing >= seat || (goal_depth(planned) > last && seat <= goal_depth(planned) + proud)) return;
    report.error(text::Code::screw_too_long, "instrument",
                 "`" + planned.instrument + "` is " + in_mm(seat) + " long, and along `" + planned.axis +
                     "` the bone ends after " + in_mm(last) +
                     ": seated, its tip would be out of it. Take one of at most " + in_mm(last) +
                     ", or ask for a depth beyond the far side.");
}

}  // namespace kerf::run
