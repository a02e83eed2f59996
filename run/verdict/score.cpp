// SPDX-License-Identifier: Apache-2.0
#include "run/verdict/score.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/plugin/unit.h"
#include "run/verdict/verdict_words.h"
#include "text/quantity.h"

namespace kerf::run {

namespace {

using session::DeductionRow;

constexpr ScoreBand critical{"critical", 0.0, 5.0}, incomplete{"incomplete", 5.0, 20.0}, serious{"serious", 20.0, 40.0},
    minor{"minor", 40.0, 60.0}, passed{"pass", 60.0, 100.0};

/// A part of what can be earned.
struct Part {
    DeductionRow row;  ///< the loss is not yet set
    double weight = 1.0;
    double earned = 0.0;  ///< 0 … 1
};

/// Returns how much of a goal has been reached, 0 … 1.
double reached_part(const StepState& state, std::size_t goal) noexcept {
    const documents::Goal& wanted = state.step->goals[goal];
    if (state.goal_done[goal]) return 1.0;
    const double at_least = wanted.bound.at_least.value_or(0.0);
    const std::optional<double> value = state.value_of_goal(goal);
    return at_least > 0.0 && value && (!wanted.bound.at_most || *value <= *wanted.bound.at_most)
               ? std::clamp(*value / at_least, 0.0, 1.0)
               : 0.0;
}

struct BrokenLimit {
    const StepState* state = nullptr;
    const LimitState* limit = nullptr;
};
/// Returns the first broken limit of a severity, with its step; null if there is none.
BrokenLimit first_broken(const StepMonitor& monitor, documents::Severity severity) noexcept {
    BrokenLimit first;
    for (const StepState& state : monitor.steps())
        for (const LimitState& limit : state.limits)
            if (limit.broken_at && limit.limit->severity == severity &&
                (first.limit == nullptr || *limit.broken_at < *first.limit->broken_at))
                first = {&state, &limit};
    return first;
}

/// Returns what keeps a run out of the band of those that pass.
DeductionRow cause_of(const ScoreBand& band, const StepMonitor& monitor, const session::RunSummary& summary) {
    const auto of_limit = [&](documents::Severity severity) {
        const BrokenLimit broken = first_broken(monitor, severity);
        return broken.limit == nullptr ? DeductionRow{.kind = "run"}
                                       : DeductionRow{.step = broken.state->step->id,
                                                      .kind = "limit",
                                                      .name = broken.limit->limit->name(),
                                                      .detail = broken_limit(*broken.limit, monitor.measures()),
                                                      .at = broken.limit->broken_at};
    };
    if (&band == &critical) return of_limit(documents::Severity::critical);
    if (&band == &serious) return of_limit(documents::Severity::serious);
    if (&band == &minor) return of_limit(documents::Severity::minor);
    for (const StepState& state : monitor.steps()) {
        if (!state.lost_hold.empty())
            return {
                .step = state.step->id, .kind = "step", .detail = "At the end of the run, " + state.lost_hold + "."};
        for (std::size_t g = 0; g < state.goal_done.size(); ++g)
            if (!state.goal_done[g])
                return {.step = state.step->id,
                        .kind = "goal",
                        .name = state.step->goals[g].name(),
                        .detail = (state.left_depth  ? "When the implant was left: "
                                   : state.is_done() ? "When the step had ended: "
                                                     : "Not reached: ") +
                                  missed_goal(state.step->goals[g], state, monitor.measures()) + ".",
                        .at = state.end};
        if (!state.is_done()) return {.step = state.step->id, .kind = "step", .detail = "The step did not end."};
    }
    return {.kind = "run", .detail = summary.reasons.empty() ? "The run is not complete." : summary.reasons.front()};
}

/// Returns the value of a metric [SI]; nothing if the run has none.
std::optional<double> value_of(const std::string& metric, const session::RunSummary& summary) {
    for (const session::MetricRow& row : summary.metrics)
        if (row.id == metric && std::isfinite(row.value)) return row.value;
    return std::nullopt;
}

/// Returns how good a value is, 0 … 1.
double quality(const documents::ScoredMetric& scored, double value) noexcept {
    const double x = scored.target ? std::abs(value - *scored.target) : value;
    return std::clamp((scored.none - x) / (scored.none - scored.full), 0.0, 1.0);
}

std::string words_of(const documents::ScoredMetric& scored, const std::optional<double>& value) {
    const double per_unit = parse_unit(scored.unit).value_or(Unit{}).factor;
    const auto text = [&](double x) {
        return text::quantity_text(std::round(x / per_unit * 1e3) * 1e-3 * per_unit, scored.unit);
    };
    return (value ? text(*value) : "not measured") + (scored.target ? ", target " + text(*scored.target) : "") +
           "; full " + text(scored.full) + ", none " + text(scored.none);
}

/// Returns a fraction as a text in whole percent; 100 % only if it is whole.
std::string percent_text(double fraction) { return text::quantity_text(std::floor(100.0 * fraction) / 100.0, "%"); }

/// Returns a text with the least fraction of a goal that a step has reached.
std::string reached_text(const StepState& state, double reached) {
    return state.has_begun() ? "The goal that is farthest from reached is at " + percent_text(reached) + "."
                             : "The step did not begin.";
}

Part step_part(const StepState& state) {
    const double reached = reached_part(state);
    return {.row = {.step = state.step->id, .kind = "step", .detail = reached_text(state, reached), .at = state.end},
            .earned = reached};
}

/// Returns the parts of a procedure with `scoring:`.
std::vector<Part> parts_by_metric(const StepMonitor& monitor, const documents::Procedure& procedure,
                                  const session::RunSummary& summary) {
    std::vector<Part> parts;
    double mean = 0.0;
    for (const StepState& state : monitor.steps())
        mean += reached_part(state) / static_cast<double>(monitor.steps().size());
    const auto add = [&](const documents::ScoredMetric& scored, double reached, const std::string& reached_words) {
        const std::optional<double> value = value_of(scored.metric, summary);
        std::string detail = words_of(scored, value);
        if (reached < 1.0) detail += ". " + reached_words;
        parts.push_back(
            {.row = {.step = scored.step, .kind = "metric", .name = scored.metric, .detail = std::move(detail)},
             .weight = scored.weight,
             .earned = value ? reached * quality(scored, *value) : 0.0});
    };
    for (const StepState& state : monitor.steps()) {
        const double reached = reached_part(state);
        bool is_scored = false;
        for (const documents::ScoredMetric& scored : procedure.scoring)
            if (scored.step == state.step->id) {
                add(scored, reached, reached_text(state, reached));
                parts.back().row.at = state.end;
                is_scored = true;
            }
        if (!is_scored) parts.push_back(step_part(state));
    }
    for (const documents::ScoredMetric& scored : procedure.scoring)
        if (scored.step.empty()) add(scored, mean, "On average the steps reached " + percent_text(mean) + ".");
    return parts;
}

/// Returns the parts of a procedure that only has goals and limits.
std::vector<Part> parts_by_limit(const StepMonitor& monitor) {
    std::vector<Part> parts;
    for (const StepState& state : monitor.steps()) {
        const double reached = reached_part(state);
        parts.push_back(step_part(state));
        for (const LimitState& limit : state.limits) {
            const bool is_measured = limit.is_seen || !limit.limit->is_of_end();
            parts.push_back({.row = {.step = state.step->id,
                                     .kind = "limit",
                                     .name = limit.limit->name(),
                                     .detail = limit.broken_at ? broken_limit(limit, monitor.measures())
                                               : !is_measured && state.has_begun() ? "It could not be measured."
                                                                                   : reached_text(state, reached),
                                     .at = limit.broken_at},
                             .earned = limit.broken_at || !is_measured ? 0.0 : reached});
        }
    }
    return parts;
}

}  // namespace

const ScoreBand& band_of(const StepMonitor& monitor, session::Verdict verdict, bool is_missing) noexcept {
    if (verdict == session::Verdict::pass) return passed;
    if (first_broken(monitor, documents::Severity::critical).limit != nullptr) return critical;
    const bool is_whole = std::all_of(monitor.steps().begin(), monitor.steps().end(), [](const StepState& state) {
        return state.is_done() && state.has_reached_all();
    });
    if (!is_whole || is_missing || verdict != session::Verdict::fail) return incomplete;
    return first_broken(monitor, documents::Severity::serious).limit != nullptr ? serious : minor;
}

double reached_part(const StepState& state) noexcept {
    if (!state.has_begun() || !state.lost_hold.empty()) return 0.0;
    double minimum = 1.0;
    for (std::size_t g = 0; g < state.goal_done.size(); ++g) minimum = std::min(minimum, reached_part(state, g));
    return minimum;
}

void score(const StepMonitor& monitor, const documents::Procedure& procedure, session::RunSummary& summary) {
    const ScoreBand& band = band_of(monitor, summary.verdict, summary.is_missing);
    const std::vector<Part> parts =
        procedure.scoring.empty() ? parts_by_limit(monitor) : parts_by_metric(monitor, procedure, summary);
    double weight = 0.0, earned = 0.0;
    for (const Part& part : parts) {
        weight += part.weight;
        earned += part.weight * part.earned;
    }
    summary.score_rules = score_rules;
    summary.score_band = band.id;
    summary.deductions.clear();
    const double quality = weight > 0.0 ? earned / weight : 0.0;
    const bool has_begun = std::any_of(monitor.steps().begin(), monitor.steps().end(),
                                       [](const StepState& state) { return state.has_begun(); });
    summary.score = has_begun ? band.lowest + (band.highest - band.lowest) * quality : 0.0;
    const auto deduct = [&](DeductionRow row, double loss) {
        if (loss <= 0.0) return;
        row.loss = loss;
        summary.deductions.push_back(std::move(row));
    };
    if (&band != &passed) deduct(cause_of(band, monitor, summary), passed.highest - band.highest);
    for (const Part& part : parts)
        deduct(part.row, (band.highest - band.lowest) * part.weight * (1.0 - part.earned) / weight);
    if (!has_begun) deduct({.kind = "run", .detail = "Nothing was done."}, band.lowest);
}

}  // namespace kerf::run
