// SPDX-License-Identifier: Apache-2.0
#include "run/run_result.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "core/plugin/unit.h"
#include "core/procedure/quantity.h"
#include "kerf/units.hpp"

namespace kerf {

namespace {

using namespace literals;

std::string millimetres(double metres) {
    char text[32];
    const long tenths = static_cast<long>(metres * 1e4 + (metres >= 0.0 ? 0.5 : -0.5));
    std::snprintf(text, sizeof text, "%s%ld.%ld mm", tenths < 0 ? "-" : "", std::labs(tenths) / 10,
                  std::labs(tenths) % 10);
    return text;
}

std::string in_degrees(double angle) { return quantity_text(std::round(angle / 0.1_deg) * 0.1_deg, "deg"); }

/// A value in its unit, four digits.
std::string rounded(double value, const std::string& unit) {
    const double per_unit = parse_unit(unit).value_or(Unit{}).factor;
    char text[40];
    const auto end = std::to_chars(text, text + sizeof text, value / per_unit, std::chars_format::general, 4).ptr;
    return std::string(text, end) + (unit.empty() ? "" : " ") + unit;
}

/// ", must be at least 100 N, at most 200 N".
std::string bounds_text(const Bound& bound, const std::string& unit) {
    std::string text = ", must be ";
    if (bound.at_least) text += "at least " + rounded(*bound.at_least, unit);
    if (bound.at_least && bound.at_most) text += " and ";
    if (bound.at_most) text += "at most " + rounded(*bound.at_most, unit);
    return text;
}

/// What a limit was broken with, after its own sentence.
std::string how_far(const LimitState& limit) {
    const std::string& quantity = limit.limit->quantity;
    if (quantity == "clearance") return limit.worst < 0.0 ? " Deepest: " + millimetres(-limit.worst) + "." : "";
    if (quantity == "depth") return " Depth: " + millimetres(limit.worst) + ".";
    if (quantity == "thrust") return " Thrust: " + quantity_text(std::round(limit.worst), "N") + ".";
    if (quantity == "plane_angle" || quantity == "hole_angle") return " Angle: " + in_degrees(limit.worst) + ".";
    if (quantity == "excess_removal")
        return " Beyond the planned hole: " + quantity_text(std::round(limit.worst * 100.0) * 0.01, "%") + ".";
    if (quantity == "time_in_air") return " In air: " + quantity_text(std::round(limit.worst * 10.0) * 0.1, "s") + ".";
    if (quantity == "torque") return " Torque: " + rounded(limit.worst, "N m") + ".";
    if (quantity == "lateral_force") return " Across the shaft: " + rounded(limit.worst, "N") + ".";
    if (quantity == "speed") return " Speed: " + rounded(limit.worst, "mm/s") + ".";
    if (quantity == "removed_volume") return " Removed: " + rounded(limit.worst, "mm3") + ".";
    if (quantity == "duration") return " Duration: " + rounded(limit.worst, "s") + ".";
    if (quantity == "signal")
        return " `" + limit.limit->signal.id + "`: " + rounded(limit.worst, limit.limit->signal.unit) + ".";
    if (quantity == "damage") return "";
    const char* what = quantity == "flatness" ? " Uneven by: "
                       : quantity == "plunge" ? " Plunged: "
                       : quantity == "breach" ? " Beyond the bone: "
                                              : " Off by: ";
    return what + millimetres(limit.worst) + ".";
}

std::string what_was_missed(const Goal& goal, const StepState& state) {
    if (goal.quantity == "entry")
        return state.has_met_bone_still && state.is_released_at_end ? "the thread never met bone"
               : state.has_met_bone_still ? "the tool stood on the bone, but it was not running"
                                          : "the tool never met bone";
    if (goal.quantity == "separated") return "the bone did not come apart";
    if (goal.quantity == "held") return "the piece was never held";
    if (goal.quantity == "moved")
        return "the piece was moved " + millimetres(state.moved) + ", must be at least " +
               millimetres(*goal.bound.at_least);
    if (goal.quantity == "removed_volume")
        return "removed " + rounded(state.removed, "mm3") + bounds_text(goal.bound, "mm3");
    if (goal.quantity == "signal") {
        const auto signal = std::find_if(state.signals.begin(), state.signals.end(),
                                         [&](const SignalState& s) { return s.signal->id == goal.signal.id; });
        const std::string name = "the signal `" + goal.signal.id + "`";
        if (signal == state.signals.end() || !signal->is_seen) return name + " was never reported";
        const std::string& unit = goal.signal.unit;
        return name + " was between " + rounded(signal->least, unit) + " and " + rounded(signal->greatest, unit) +
               bounds_text(goal.bound, unit);
    }
    std::string text = "depth " + millimetres(std::max(0.0, state.deepest));
    if (goal.bound.at_least) text += ", must be at least " + millimetres(*goal.bound.at_least);
    if (goal.bound.at_most) text += ", must be at most " + millimetres(*goal.bound.at_most);
    return text;
}

}  // namespace

void judge(const StepMonitor& monitor, RunEnd end, double duration, double time_limit, RunSummary& summary) {
    int demands = 0, met = 0;
    bool is_broken = false, is_missing = false;
    for (const auto& state : monitor.steps()) {
        StepRow row{state.step->id,
                    state.step->title,
                    state.is_done(),
                    state.start.value_or(0.0),
                    state.end.value_or(duration),
                    {}};
        for (const auto& limit : state.limits) {
            ++demands;
            if (state.is_done() && limit.limit->is_of_wall() && !limit.is_seen) {
                is_missing = true;
                summary.reasons.push_back("Step `" + state.step->id +
                                          "`: its cut left no wall near the planned plane to measure " +
                                          limit.limit->quantity + " on.");
                continue;
            }
            if (state.is_done() && limit.limit->is_of_hole() && !limit.is_seen) {
                is_missing = true;
                summary.reasons.push_back(
                    "Step `" + state.step->id + "`: it left no hole to measure " + limit.limit->quantity + " on" +
                    (limit.limit->quantity == "hole_angle" ? " that is two diameters long." : "."));
                continue;
            }
            if (!limit.broken_at) {
                ++met;
                continue;
            }
            is_broken = true;
            row.broken_limits.push_back(limit.limit->name());
            summary.reasons.push_back("Step `" + state.step->id + "`: " + limit.limit->reason + how_far(limit));
        }
        for (std::size_t g = 0; g < state.goal_done.size(); ++g) {
            ++demands;
            met += state.goal_done[g];
            if (state.goal_done[g]) continue;
            is_missing = true;
            summary.reasons.push_back("Step `" + state.step->id + "`: " + what_was_missed(state.step->goals[g], state) +
                                      ".");
        }
        if (!state.is_done() && !is_missing && !is_broken) {
            is_missing = true;
            summary.reasons.push_back(
                "Step `" + state.step->id + "`: the " +
                (state.is_released_at_end ? "implant was not released." : "tool was not withdrawn."));
        }
        summary.steps.push_back(std::move(row));
    }
    if (end == RunEnd::time_over)
        summary.reasons.push_back("The run reached the procedure's `time_limit:` of " + quantity_text(time_limit, "s") +
                                  ".");
    if (end == RunEnd::interrupted) summary.reasons.insert(summary.reasons.begin(), "The run was interrupted.");
    if (end == RunEnd::unrecorded)
        summary.reasons.insert(summary.reasons.begin(), "The run ended early: it could not be recorded any more.");
    is_missing = is_missing || end == RunEnd::interrupted || end == RunEnd::unrecorded;
    summary.verdict = end == RunEnd::fault ? Verdict::invalid
                      : is_broken          ? Verdict::fail
                      : is_missing         ? Verdict::incomplete
                                           : Verdict::pass;
    if (end == RunEnd::fault)
        summary.reasons.insert(summary.reasons.begin(), "The force law or the solve failed; force was released.");
    summary.score = demands > 0 ? 100.0 * met / demands : 100.0;
}

bool ended_as_expected(const Rehearsal& rehearsal, const StepMonitor& monitor, Verdict verdict) {
    if (rehearsal.expect == "pass") return verdict == Verdict::pass;
    if (rehearsal.expect == "incomplete") return verdict == Verdict::incomplete;
    if (verdict != Verdict::fail) return false;
    bool is_named = false;
    for (const auto& state : monitor.steps()) {
        for (const auto& limit : state.limits) {
            if (!limit.broken_at) continue;
            const bool is_the_one = rehearsal.expect_limit == limit.limit->name() &&
                                    (rehearsal.expect_step.empty() || rehearsal.expect_step == state.step->id);
            if (!is_the_one && !rehearsal.expects_others) return false;
            is_named = is_named || is_the_one;
        }
        // "For that alone": everything else went well.
        if (!rehearsal.expects_others &&
            std::find(state.goal_done.begin(), state.goal_done.end(), false) != state.goal_done.end())
            return false;
    }
    return is_named;
}

}  // namespace kerf
