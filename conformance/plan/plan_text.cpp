// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "conformance/plan/plan_text.h"

#include <cmath>
#include <cstdio>

#include "core/procedure/plain_numbers.h"
#include "core/procedure/quantity.h"
#include "core/session/recorder.h"

namespace kerf::plan {

namespace {

/// Two digits: an error is not known better.
std::string percent(double share) {
    const PlainNumbers point;
    char text[32];
    const double value = 100.0 * share;
    std::snprintf(text, sizeof text, value > 0.0 && value < 0.005 ? "<0.01 %%" : "%.2g %%", value < 99.5 ? value : std::round(value));
    if (value >= 99.5) std::snprintf(text, sizeof text, "%.0f %%", value);
    return text;
}

std::string two_digits(double value, const char* unit) {
    const PlainNumbers point;
    char text[32];
    std::snprintf(text, sizeof text, value < 99.5 ? "%.2g %s" : "%.0f %s", value, unit);
    return text;
}

std::string column(std::string text, std::size_t width) {
    std::size_t shown = 0;  // columns are characters, not bytes
    for (const char c : text) shown += (static_cast<unsigned char>(c) & 0xc0u) != 0x80u;
    text.append(shown < width ? width - shown : 1, ' ');
    return text;
}

std::string errors(const Apart& a) {
    return column(percent(a.force), 10) + column(percent(a.torque), 10) + column(percent(a.volume), 10);
}

std::string pitch_text(const Task& task, double pitch) {
    const auto found = pitch_of(task.force);
    return found ? quantity_text(pitch, found->unit) : "-";
}

bool is_same(const Choice& a, const Choice& b) { return a.spacing == b.spacing && a.pitch == b.pitch; }

/// What of the procedure a reader would have to write anew, as the patch of a variant.
std::string to_write(const Task& task, const StepPlan& plan) {
    const std::string indent = "        ", parameter = indent + "instruments." + task.instrument + ".parameters.";
    std::string text;
    if (plan.chosen.spacing != task.spacing) text += indent + "accuracy.spacing: " + quantity_text(plan.chosen.spacing, "mm") + "\n";
    const auto pitch = pitch_of(task.force);
    if (pitch && plan.chosen.pitch != task.setup.force_parameters[pitch->param])
        text += parameter + task.force.parameters[pitch->param].id + ": " + quantity_text(plan.chosen.pitch, pitch->unit) + "\n";
    for (const FeatureFound& feature : plan.features) {
        if (!feature.is_left_out) continue;
        for (const ComponentInfo* info : {&task.tool, &task.force})
            for (const FeatureInfo& line : info->features)
                if (line.id == feature.id) {
                    const ParameterInfo& p = info->parameters[line.param];
                    text += parameter + p.id + ": " + quantity_text(line.off, p.display_unit) + "\n";
                }
    }
    return text;
}

}  // namespace

std::string plan_text(const Task& task, const StepPlan& plan) {
    std::string text = "step " + plan.step + ": " + two_digits(1e3 * task.way.length, "mm") + " at " +
                       two_digits(1e3 * task.way.feed, "mm/s") + "\n";
    text += "  asked for     force within " + percent(task.accuracy.force) + ", bone removed within " +
            percent(task.accuracy.volume) + ", " + two_digits(1e6 * task.budget.tick, "us") + " a tick\n";
    text += "  held against  " + quantity_text(plan.reference.spacing, "mm") + ", elements of " +
            pitch_text(task, plan.reference.pitch) + ": " + two_digits(plan.reference_force, "N") + " and " +
            two_digits(1e3 * plan.reference_torque, "N mm") + " (RMS along the way)\n\n";
    text += "  " + column("spacing", 10) + column("elements", 10) + column("force", 10) + column("torque", 10) +
            column("removed", 10) + "\n";
    bool is_marked = false;
    for (const Choice& choice : plan.tried) {
        text += "  " + column(quantity_text(choice.spacing, "mm"), 10) + column(pitch_text(task, choice.pitch), 10);
        const bool is_chosen = !is_marked && is_same(choice, plan.chosen);
        is_marked = is_marked || is_chosen;
        text += choice.has_bone ? errors(choice.error) + (is_chosen ? "chosen" : "") : "the bone cannot be made so coarsely";
        text += "\n";
    }
    text += "\n  " + column("without", 22) + column("force", 10) + column("torque", 10) + column("removed", 10) + "\n";
    for (const FeatureFound& feature : plan.features)
        text += "  " + column(feature.id, 22) + errors(feature.change) + (feature.is_left_out ? "left out: " : "kept: ") +
                feature.help + "\n";
    text += "\n  together      force " + percent(plan.chosen.error.force) + ", torque " +
            percent(plan.chosen.error.torque) + ", bone removed " + percent(plan.chosen.error.volume) + " off: " +
            (plan.keeps_accuracy ? "as accurate as asked for\n" : "NOT as accurate as asked for; nothing coarser than the reference is\n");
    text += "  a tick takes  " + two_digits(plan.cost.median, "us") + ", " + two_digits(plan.cost.p999, "us") +
            " in 999 of 1000, at most " + two_digits(plan.cost.longest, "us") + ": " +
            (plan.keeps(task.budget) ? "within the budget" : "OVER the budget: ask for less accuracy or allow more") +
            "\n  as written    " + two_digits(plan.cost_as_written.median, "us") + ", " +
            two_digits(plan.cost_as_written.p999, "us") + " in 999 of 1000\n";
    text += "  all of it along the planned way: a drill that leans or stalls may need what is left out\n";
    const std::string write = to_write(task, plan);
    text += write.empty() ? "  the procedure is written so already\n" : "  to have it so, write under `variants:`\n    planned-" + plan.step + ":\n      patch:\n" + write;
    return text;
}

std::string plan_csv(std::span<const StepPlan> plans) {
    std::string text = std::string("# ") + notice_line + "\nstep,what,spacing_m,pitch,force_error,torque_error,volume_error,outcome\n";
    const auto row = [&](const StepPlan& plan, const std::string& what, double spacing, double pitch, const Apart& a,
                         const char* outcome) {
        const PlainNumbers point;
        char figures[200];
        std::snprintf(figures, sizeof figures, "%.6g,%.6g,%.6g,%.6g,%.6g", spacing, pitch, a.force, a.torque, a.volume);
        text += plan.step + "," + what + "," + figures + "," + outcome + "\n";
    };
    for (const StepPlan& plan : plans) {
        for (const Choice& c : plan.tried) row(plan, "tried", c.spacing, c.pitch, c.error, c.has_bone ? "" : "no bone");
        for (const FeatureFound& f : plan.features)
            row(plan, "without " + f.id, plan.chosen.spacing, plan.chosen.pitch, f.change, f.is_left_out ? "left out" : "kept");
        row(plan, "chosen", plan.chosen.spacing, plan.chosen.pitch, plan.chosen.error, plan.keeps_accuracy ? "accurate" : "not accurate");
    }
    return text;
}

}  // namespace kerf::plan
