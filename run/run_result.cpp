// SPDX-License-Identifier: Apache-2.0
#include "run/run_result.h"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "run/verdict/verdict_words.h"
#include "text/quantity.h"

namespace kerf::run {

namespace {

/// Returns whether the hand never came to a step. The first one is where a run begins, so it always did.
bool is_unreached(const StepState& state, bool is_first) {
    return !is_first && !state.is_done() && !state.has_begun() && !state.has_met_bone_still && state.lost_hold.empty();
}

/// Returns "Steps `a`, `b` and `c` were not reached."; empty for none.
std::string unreached_text(const std::vector<std::string>& steps) {
    if (steps.empty()) return {};
    std::string text = steps.size() == 1 ? "Step `" : "Steps `";
    for (std::size_t i = 0; i < steps.size(); ++i)
        text += (i == 0 ? "" : i + 1 == steps.size() ? "` and `" : "`, `") + steps[i];
    return text + (steps.size() == 1 ? "` was not reached." : "` were not reached.");
}

/// Adds why a run ended before its steps were done.
void add_reason_of(RunEnd end, double time_limit, std::vector<std::string>& reasons) {
    if (end == RunEnd::time_over)
        reasons.push_back("The run reached the procedure's `time_limit:` of " + text::quantity_text(time_limit, "s") +
                          ".");
    if (end == RunEnd::interrupted) reasons.insert(reasons.begin(), "The run was interrupted.");
    if (end == RunEnd::unrecorded)
        reasons.insert(reasons.begin(), "The run ended early: it could not be recorded any more.");
    if (end == RunEnd::device_silent)
        reasons.insert(reasons.begin(), "The run ended early: the device was silent for 10 s.");
    if (end == RunEnd::fell_behind)
        reasons.insert(reasons.begin(),
                       "The run ended early: this machine is too slow to record it while it is on the clock.");
    if (end == RunEnd::diverged)
        reasons.insert(reasons.begin(),
                       "The same inputs gave two results: a force law is not a function of its inputs, such as "
                       "one that keeps values outside its state.");
}

}  // namespace

void judge(const StepMonitor& monitor, RunEnd end, double duration, double time_limit, session::RunSummary& summary) {
    const std::vector<documents::Measure>& measures = monitor.measures();
    bool is_broken = false, is_missing = false;
    std::vector<std::string> unreached;
    for (const auto& state : monitor.steps()) {
        session::StepRow row{state.step->id,
                             state.step->title,
                             state.is_done(),
                             state.start.value_or(0.0),
                             state.end.value_or(duration),
                             {}};
        for (const auto& limit : state.limits) {
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
            if (state.is_done() && limit.limit->quantity == "measure" && !limit.is_seen) {
                is_missing = true;
                summary.reasons.push_back("Step `" + state.step->id +
                                          "`: " + why_unmeasured(limit.limit->measure, state, measures) + ".");
                continue;
            }
            if (!limit.broken_at) continue;
            is_broken = true;
            row.broken_limits.push_back(limit.limit->name());
            summary.reasons.push_back("Step `" + state.step->id + "`: " + broken_limit(limit, measures));
        }
        if (!state.lost_hold.empty()) {
            is_broken = true;
            summary.reasons.push_back("Step `" + state.step->id + "`: at the end of the run, " + state.lost_hold + ".");
        }
        const bool is_left_out = is_unreached(state, &state == monitor.steps().data());
        if (is_left_out) {
            is_missing = true;
            unreached.push_back(state.step->id);
        }
        for (std::size_t g = 0; g < state.goal_done.size() && !is_left_out; ++g) {
            if (state.goal_done[g] || !state.lost_hold.empty()) continue;
            (state.is_done() ? is_broken : is_missing) = true;
            summary.reasons.push_back("Step `" + state.step->id + "`: " +
                                      (!state.is_done()   ? ""
                                       : state.left_depth ? "when the implant was left, "
                                                          : "when the step had ended, ") +
                                      missed_goal(state.step->goals[g], state, measures) + ".");
        }
        if (!state.is_done() && !is_missing && !is_broken) {
            is_missing = true;
            summary.reasons.push_back(
                "Step `" + state.step->id + "`: the " +
                (state.is_released_at_end ? "implant was not released." : "tool was not withdrawn."));
        }
        for (const std::string& text : undecided(state, measures))
            summary.reasons.push_back("Step `" + state.step->id + "`: " + text);
        summary.steps.push_back(std::move(row));
    }
    if (!unreached.empty()) summary.reasons.push_back(unreached_text(unreached));
    add_reason_of(end, time_limit, summary.reasons);
    is_missing = is_missing || end == RunEnd::interrupted || end == RunEnd::unrecorded ||
                 end == RunEnd::device_silent || end == RunEnd::fell_behind;
    summary.is_missing = is_missing;
    const bool is_invalid = end == RunEnd::fault || end == RunEnd::diverged;
    summary.verdict = is_invalid   ? session::Verdict::invalid
                      : is_broken  ? session::Verdict::fail
                      : is_missing ? session::Verdict::incomplete
                                   : session::Verdict::pass;
    if (end == RunEnd::fault)
        summary.reasons.insert(summary.reasons.begin(), "The force law or the solve failed; force was released.");
}

bool ended_as_expected(const documents::Rehearsal& rehearsal, const StepMonitor& monitor, session::Verdict verdict) {
    if (rehearsal.expect == "pass") return verdict == session::Verdict::pass;
    if (rehearsal.expect == "incomplete") return verdict == session::Verdict::incomplete;
    if (verdict != session::Verdict::fail) return false;
    bool is_named = false;
    for (const auto& state : monitor.steps()) {
        const bool is_step = rehearsal.expect_step.empty() || rehearsal.expect_step == state.step->id;
        // Returns whether the rehearsal allows what went wrong.
        const auto allows = [&](const std::string& name) {
            const bool is_the_one = is_step && rehearsal.expect_limit == name;
            is_named = is_named || is_the_one;
            return is_the_one || rehearsal.expects_others;
        };
        for (const auto& limit : state.limits)
            if (limit.broken_at && !allows(limit.limit->name())) return false;
        // "Because of that alone": all other goals were reached. One of a step that did not end is not the one.
        for (std::size_t g = 0; g < state.goal_done.size(); ++g)
            if (!state.goal_done[g] && !allows(state.is_done() ? state.step->goals[g].name() : "")) return false;
    }
    return is_named;
}

}  // namespace kerf::run
