// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/plan/plan_text.h"

#include <cmath>
#include <cstddef>
#include <cstdio>

#include "session/recorder.h"
#include "text/plain_numbers.h"
#include "text/quantity.h"

namespace kerf::plan {

namespace {

/// Two digits: an error is not known better.
std::string percent(double share) {
    const text::PlainNumbers point;
    char text[32];
    const double value = 100.0 * share;
    std::snprintf(text, sizeof text, value > 0.0 && value < 0.005 ? "<0.01 %%" : "%.2g %%",
                  value < 99.5 ? value : std::round(value));
    if (value >= 99.5) std::snprintf(text, sizeof text, "%.0f %%", value);
    return text;
}

std::string two_digits(double value, const char* unit) {
    const text::PlainNumbers point;
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

std::string microseconds(const Cost& cost) {
    return two_digits(cost.median, "us") + ", " + two_digits(cost.p999, "us");
}

std::string pitch_text(const Task& task, double pitch) {
    const auto found = pitch_of(task.force);
    return found ? text::quantity_text(pitch, found->unit) : "-";
}

std::string where(const Task& task, const Choice& choice) {
    return text::quantity_text(choice.spacing, "mm") +
           (pitch_of(task.force) ? ", elements of " + pitch_text(task, choice.pitch) : "");
}

std::string errors_said(const Apart& a) {
    return "force " + percent(a.force) + ", torque " + percent(a.torque) + ", bone removed " + percent(a.volume) +
           " off";
}

/// What comes nearest to keeping both, from either side.
std::string near_misses(const Task& task, const StepPlan& plan) {
    const double budget = 1e6 * task.budget.tick, over = plan.chosen.cost->p999 - budget;
    std::string text =
        "  NOTHING that was tried keeps both the accuracy and the budget. What comes nearest:\n    accurate    ";
    text += plan.keeps_accuracy
                ? where(task, plan.chosen) + ": " + two_digits(plan.chosen.cost->p999, "us") + " in 999 of 1000, " +
                      two_digits(over, "us") + " (" + percent(over / budget) + ") over the budget\n"
                : "nothing\n";
    const auto said = [&](const Cheaper& c) {
        return where(task, c.choice) + (c.without.empty() ? "" : ", without " + c.without);
    };
    const Cheaper chosen{plan.chosen, ""}, *cheapest = nullptr, *nearest = plan.keeps(task.budget) ? &chosen : nullptr;
    for (const Cheaper& c : plan.cheaper) {
        const auto miss = [&](const Cheaper& of) { return of.choice.miss(task.accuracy, plan.torque_counts); };
        if (c.choice.keeps(task.budget) && (nearest == nullptr || miss(c) < miss(*nearest))) nearest = &c;
        if (cheapest == nullptr || c.choice.cost->p999 < cheapest->choice.cost->p999) cheapest = &c;
    }
    text += "    in budget   ";
    if (nearest != nullptr)
        return text + said(*nearest) + ": " + two_digits(nearest->choice.cost->p999, "us") + " in 999 of 1000; " +
               errors_said(nearest->choice.error) + ", " +
               two_digits(nearest->choice.miss(task.accuracy, plan.torque_counts), "times") + " what may be\n";
    text += "nothing";
    if (cheapest != nullptr && cheapest->choice.cost->p999 < plan.chosen.cost->p999)
        text += "; the cheapest is " + said(*cheapest) + ": " + two_digits(cheapest->choice.cost->p999, "us") +
                " in 999 of 1000; " + errors_said(cheapest->choice.error);
    return text + "\n";
}

std::string verdict_on_cost(const Task& task, const StepPlan& plan) {
    if (plan.keeps(task.budget))
        return task.budget.is_given ? "within the budget" : "within " + two_digits(1e6 * task.budget.tick, "us");
    if (task.budget.is_given) return "OVER the budget: ask for less accuracy or allow more";
    return "OVER " + two_digits(1e6 * task.budget.tick, "us") +
           ": write `budget: {tick: …}`, and the plan searches what keeps it";
}

/// What of the procedure a reader would have to write anew, as the patch of a variant.
std::string to_write(const Task& task, const StepPlan& plan) {
    const std::string indent = "        ", parameter = indent + "instruments." + task.instrument + ".parameters.";
    std::string text;
    if (plan.chosen.spacing != task.spacing)
        text += indent + "accuracy.spacing: " + text::quantity_text(plan.chosen.spacing, "mm") + "\n";
    const auto pitch = pitch_of(task.force);
    if (pitch && plan.chosen.pitch != task.setup.force_parameters[pitch->param])
        text += parameter + task.force.parameters[pitch->param].id + ": " +
                text::quantity_text(plan.chosen.pitch, pitch->unit) + "\n";
    for (const FeatureFound& feature : plan.features) {
        if (!feature.is_left_out) continue;
        for (const ComponentInfo* info : {&task.tool, &task.force})
            for (const FeatureInfo& line : info->features)
                if (line.id == feature.id) {
                    const ParameterInfo& p = info->parameters[line.param];
                    text += parameter + p.id + ": " + text::quantity_text(line.off, p.display_unit) + "\n";
                }
    }
    return text;
}

}  // namespace

std::string plan_text(const Task& task, const StepPlan& plan) {
    std::string text = "step " + plan.step + ": " + two_digits(1e3 * task.way.length, "mm") + " at " +
                       two_digits(1e3 * task.way.feed, "mm/s") + "\n";
    text += std::string("  required      ") + (plan.torque_counts ? "force and torque" : "force") + " within " +
            percent(task.accuracy.force) + ", bone removed within " + percent(task.accuracy.volume) +
            (task.budget.is_given ? ", " + two_digits(1e6 * task.budget.tick, "us") + " a tick" : "; no budget") + "\n";
    text += "  reference     " + text::quantity_text(plan.reference.spacing, "mm") + ", elements of " +
            pitch_text(task, plan.reference.pitch) + ": " + two_digits(plan.reference_force, "N") + " and " +
            two_digits(1e3 * plan.reference_torque, "N mm") + " (RMS along the path)" +
            (plan.torque_counts ? "" : "; so little torque does not count") + "\n\n";
    text += "  " + column("spacing", 10) + column("elements", 10) + column("force", 10) + column("torque", 10) +
            column("removed", 10) + "a tick, 999 of 1000\n";
    bool is_marked = false;
    for (const Choice& choice : plan.tried) {
        text +=
            "  " + column(text::quantity_text(choice.spacing, "mm"), 10) + column(pitch_text(task, choice.pitch), 10);
        const bool is_chosen = !is_marked && is_same(choice, plan.chosen);
        is_marked = is_marked || is_chosen;
        if (!choice.has_bone)
            text += "the bone cannot be made so coarsely\n";
        else
            text += errors(choice.error) + column(choice.cost ? microseconds(*choice.cost) : "", 20) +
                    (choice.is_over_budget ? "over the budget" : "") +
                    (choice.is_over_budget && is_chosen ? ", " : "") + (is_chosen ? "chosen" : "") + "\n";
    }
    text += "\n  " + column("without", 22) + column("force", 10) + column("torque", 10) + column("removed", 10) + "\n";
    for (const FeatureFound& feature : plan.features)
        text += "  " + column(feature.id, 22) + errors(feature.change) +
                (feature.is_left_out ? "left out: " : "kept: ") + feature.help + "\n";
    text += "\n  together      " + errors_said(plan.chosen.error) + ": " +
            (plan.keeps_accuracy ? "as accurate as required\n"
                                 : "NOT as accurate as required; nothing coarser than the reference is\n");
    const Cost& cost = *plan.chosen.cost;
    text += "  a tick takes  " + microseconds(cost) + " in 999 of 1000, at most " + two_digits(cost.longest, "us") +
            ": " + verdict_on_cost(task, plan) + "\n  as written    " + microseconds(plan.cost_as_written) +
            " in 999 of 1000\n";
    if (task.budget.is_given && !(plan.keeps_accuracy && plan.keeps(task.budget))) text += near_misses(task, plan);
    text += "  all of it along the planned way: a drill that leans or stalls may need what is left out\n";
    const std::string write = to_write(task, plan);
    text += write.empty()
                ? "  the procedure is written so already\n"
                : "  to have it so, write under `variants:`\n    planned-" + plan.step + ":\n      patch:\n" + write;
    return text;
}

std::string plan_csv(std::span<const StepPlan> plans) {
    std::string text = std::string("# ") + session::notice_line +
                       "\nstep,what,spacing_m,pitch,force_error,torque_error,volume_error,outcome\n";
    const auto row = [&](const StepPlan& plan, const std::string& what, double spacing, double pitch, const Apart& a,
                         const char* outcome) {
        const text::PlainNumbers point;
        char figures[200];
        std::snprintf(figures, sizeof figures, "%.6g,%.6g,%.6g,%.6g,%.6g", spacing, pitch, a.force, a.torque, a.volume);
        text += plan.step + "," + what + "," + figures + "," + outcome + "\n";
    };
    for (const StepPlan& plan : plans) {
        for (const Choice& c : plan.tried) row(plan, "tried", c.spacing, c.pitch, c.error, c.has_bone ? "" : "no bone");
        for (const FeatureFound& f : plan.features)
            row(plan, "without " + f.id, plan.chosen.spacing, plan.chosen.pitch, f.change,
                f.is_left_out ? "left out" : "kept");
        row(plan, "chosen", plan.chosen.spacing, plan.chosen.pitch, plan.chosen.error,
            plan.keeps_accuracy ? "accurate" : "not accurate");
    }
    return text;
}

}  // namespace kerf::plan
