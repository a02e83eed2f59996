// SPDX-License-Identifier: Apache-2.0
#include "run/thread_checks.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/procedure/document.h"
#include "core/procedure/quantity.h"
#include "core/procedure/read_map.h"
#include "core/procedure/read_procedure.h"

namespace kerf {

namespace {

/// To a hundredth of a millimetre.
std::string in_mm(double length) { return quantity_text(std::round(length / 0.01e-3) * 0.01e-3, "mm"); }

/// Complaints about one step of a procedure.
class StepReport {
public:
    StepReport(const Procedure& procedure, std::size_t step, Diagnostics& diagnostics)
        : document_(document_of(procedure)), step_(step), report_(*document_, diagnostics) {}

    /// Under one of the step's keys; under the step where it has none.
    void error(Code code, const char* key, const std::string& text) {
        const Node* steps = document_->root.find("steps");
        const Node* item = steps != nullptr && step_ < steps->children.size() ? &steps->children[step_] : nullptr;
        const Node* value = item != nullptr ? item->find(key) : nullptr;
        report_.error(code, value != nullptr ? value->span : item != nullptr ? item->span : TextSpan{}, text);
    }

private:
    std::shared_ptr<const Document> document_;
    std::size_t step_;
    Report report_;
};

double seat_of(const ToolOutline& tool) noexcept { return -tool.cutting.end_z(); }

/// The radius of a screw behind its tip's cone.
double tip_core(const ToolOutline& tool) noexcept {
    return tool.profile[std::min<std::size_t>(1, tool.cutting_count - 1)].radius;
}

double asked_depth(const Step& step) noexcept {
    double depth = -HUGE_VAL;
    for (const Goal& goal : step.goals)
        if (goal.quantity == "depth") depth = std::max(depth, goal.bound.at_least.value_or(depth));
    return depth;
}

}  // namespace

void check_threads(const Procedure& procedure, const std::vector<const ToolOutline*>& tools, Diagnostics& diagnostics) {
    for (std::size_t s = 0; s < procedure.steps.size(); ++s) {
        const Step& step = procedure.steps[s];
        const ToolOutline& tool = *tools[s];
        if (!tool.has_thread()) continue;
        StepReport report(procedure, s, diagnostics);
        double hole = 0.0;  // [m] the widest radius that was drilled there before
        for (std::size_t before = 0; before < s; ++before) {
            const ToolOutline& other = *tools[before];
            if (procedure.steps[before].axis != step.axis) continue;
            if (!other.has_thread() && !other.cutting.is_prism()) hole = std::max(hole, other.cutting.largest_radius());
            constexpr double same = 0.02;  // [–], as the law of the screw takes it
            if (other.has_thread() && !other.is_implant() &&
                std::abs(other.thread_lead - tool.thread_lead) > same * tool.thread_lead)
                report.error(Code::other_lead, "instrument",
                             "`" + step.instrument + "` goes " + in_mm(tool.thread_lead) + " in a turn, and `" +
                                 procedure.steps[before].instrument + "`, which cuts its thread in step `" +
                                 procedure.steps[before].id + "`, " + in_mm(other.thread_lead) +
                                 ". Give both the same `pitch` and `starts`.");
        }
        if (hole <= 0.0)
            report.error(Code::no_hole, "instrument",
                         "`" + step.instrument + "` has a thread, and no step before `" + step.id +
                             "` drills a hole along `" + step.axis +
                             "`. Put one before it, with a drill about as wide as its core, " +
                             in_mm(2.0 * tip_core(tool)) + ".");
        else if (tip_core(tool) > hole)
            report.error(Code::core_too_wide, "instrument",
                         "The tip of `" + step.instrument + "` has a core of " + in_mm(2.0 * tip_core(tool)) +
                             ", and the hole along `" + step.axis + "` is " + in_mm(2.0 * hole) +
                             " wide. Take a wider drill, or a screw with a core of at most " + in_mm(2.0 * hole) + ".");
        if (const double asked = asked_depth(step); tool.is_implant() && asked > seat_of(tool))
            report.error(Code::seats_too_soon, "goals",
                         "The goal is a depth of at least " + in_mm(asked) + ", and the head of `" + step.instrument +
                             "` seats at " + in_mm(seat_of(tool)) + ". Take a longer one, or ask for no more.");
    }
}

void check_length_in_bone(const Procedure& procedure, std::size_t step, const ToolOutline& tool, const AxisFrame& frame,
                          const Body& body, Diagnostics& diagnostics) {
    if (!tool.is_implant()) return;
    const double seat = seat_of(tool), spacing = body.grid().spacing;
    double last = 0.0;  // [m] of bone along the axis
    for (double depth = 0.0; depth <= seat + spacing; depth += spacing)
        if (uncut_distance(body, locate(body, frame.entry + depth * frame.along)) < 0.0) last = depth;
    if (last + spacing >= seat || asked_depth(procedure.steps[step]) > last) return;
    StepReport(procedure, step, diagnostics)
        .error(Code::screw_too_long, "instrument",
               "`" + procedure.steps[step].instrument + "` is " + in_mm(seat) + " long, and along `" +
                   procedure.steps[step].axis + "` the bone ends after " + in_mm(last) +
                   ": seated, its tip would be out of it. Take one of at most " + in_mm(last) +
                   ", or ask for a depth beyond the far side.");
}

}  // namespace kerf
