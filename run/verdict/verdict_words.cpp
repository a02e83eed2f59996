// SPDX-License-Identifier: Apache-2.0
#include "run/verdict/verdict_words.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/plugin/unit.h"
#include "run/verdict/within_bound.h"
#include "text/distinguishing_digits.h"
#include "text/quantity.h"

namespace kerf::run {

namespace {

/// Returns a number with this many decimals, rounded half away from zero. Zero has no sign.
std::string with_decimals(double value, int decimals) {
    const double scale = std::pow(10.0, decimals);
    const double nearest = std::round(value * scale) / scale;
    char text[400];
    const auto end =
        std::to_chars(text, text + sizeof text, nearest == 0.0 ? 0.0 : nearest, std::chars_format::fixed, decimals).ptr;
    return {text, end};
}

std::string mm_text(double metres, int decimals = 1) { return with_decimals(metres * 1e3, decimals) + " mm"; }

/// Returns a value in its unit with this many significant digits.
std::string with_significant_digits(double value, const std::string& unit, int digits = 4) {
    const double per_unit = parse_unit(unit).value_or(Unit{}).factor;
    char text[40];
    const auto end = std::to_chars(text, text + sizeof text, value / per_unit, std::chars_format::general, digits).ptr;
    return std::string(text, end) + (unit.empty() ? "" : " ") + unit;
}

/// Returns a value in its unit, without trailing zeros.
std::string with_decimals_and_unit(double value, const std::string& unit, int decimals) {
    const double step = std::pow(10.0, -decimals) * parse_unit(unit).value_or(Unit{}).factor;
    return text::quantity_text(std::round(value / step) * step, unit);
}

constexpr int max_digits = 12;

/// Returns the number of digits at which the text of `value` differs from each end of `bound`, unless they are equal.
template <class TextOf>
int distinguishing_digits_of(double value, const documents::Bound& bound, int digits, const TextOf& text_of) {
    int enough = digits;
    for (const auto& end : {bound.at_least, bound.at_most})
        if (end) enough = std::max(enough, text::distinguishing_digits(value, *end, digits, max_digits, text_of));
    return enough;
}

/// Returns ", must be at least 100 N and at most 200 N".
template <class TextOf>
std::string bounds_text(const documents::Bound& bound, const TextOf& text_of) {
    std::string text = ", must be ";
    if (bound.at_least) text += "at least " + text_of(*bound.at_least);
    if (bound.at_least && bound.at_most) text += " and ";
    if (bound.at_most) text += "at most " + text_of(*bound.at_most);
    return text;
}

/// Returns the unit of a measure for people; empty for an unknown measure.
std::string unit_of(const std::string& measure, const std::vector<documents::Measure>& measures) {
    for (const documents::Measure& one : measures)
        if (one.id == measure) return one.unit();
    return {};
}

/// Returns the value that broke a limit, as a sentence behind a space; nothing where the reason is enough.
std::string how_far(const LimitState& limit, const std::vector<documents::Measure>& measures) {
    const std::string& quantity = limit.limit->quantity;
    const auto sentence = [&](const char* what, int digits, const auto& text_of) {
        return what + text_of(limit.worst, distinguishing_digits_of(limit.worst, limit.limit->bound, digits, text_of)) +
               ".";
    };
    const auto with_digits = [&](const char* what, const std::string& unit) {
        return sentence(what, 4,
                        [&](double value, int digits) { return with_significant_digits(value, unit, digits); });
    };
    const auto with_steps = [&](const char* what, const std::string& unit, int decimals) {
        return sentence(what, decimals,
                        [&](double value, int more) { return with_decimals_and_unit(value, unit, more); });
    };
    const auto length = [&](const char* what) { return sentence(what, 1, mm_text); };

    if (quantity == "clearance")
        return limit.worst < 0.0
                   ? sentence(" Deepest: ", 1, [](double value, int decimals) { return mm_text(-value, decimals); })
                   : length(" Nearest: ");
    if (quantity == "depth") return length(" Depth: ");
    if (quantity == "thrust") return with_steps(" Thrust: ", "N", 0);
    if (quantity == "plane_angle" || quantity == "hole_angle" || quantity == "reduction_angle" ||
        quantity == "axes_angle")
        return with_steps(" Angle: ", "deg", 1);
    if (quantity == "excess_removal") return with_steps(" Beyond the planned hole: ", "%", 0);
    if (quantity == "time_in_air") return with_steps(" In air: ", "s", 1);
    if (quantity == "torque") return with_digits(" Torque: ", "N m");
    if (quantity == "lateral_force") return with_digits(" Across the shaft: ", "N");
    if (quantity == "speed") return with_digits(" Speed: ", "mm/s");
    if (quantity == "removed_volume") return with_digits(" Removed: ", "mm3");
    if (quantity == "duration") return with_digits(" Duration: ", "s");
    if (quantity == "signal")
        return with_digits((" `" + limit.limit->signal.id + "`: ").c_str(), limit.limit->signal.unit);
    if (quantity == "measure")
        return with_steps((" `" + limit.limit->measure + "`: ").c_str(), unit_of(limit.limit->measure, measures), 1);
    if (quantity == "damage") return "";
    if (quantity == "tip_apex") return length(" Tip to apex: ");
    if (quantity == "flatness") return length(" Uneven by: ");
    if (quantity == "plunge") return length(" Plunged: ");
    if (quantity == "breach") return length(" Beyond the bone: ");
    return length(" Off by: ");
}

/// Returns "`name` 59.98 mm, must be at least 60.00 mm".
template <class TextOf>
std::string missed_bound(const std::string& name, double value, const documents::Bound& bound, int digits,
                         const TextOf& text_of) {
    const int enough = distinguishing_digits_of(value, bound, digits, text_of);
    return name + text_of(value, enough) + bounds_text(bound, [&](double end) { return text_of(end, enough); });
}

/// Returns "1.0 ± 0.5 deg", with two digits of the uncertainty.
std::string with_uncertainty(double value, double uncertainty, const std::string& unit) {
    const double per_unit = parse_unit(unit).value_or(Unit{}).factor;
    const int decimals =
        std::clamp(1 - static_cast<int>(std::floor(std::log10(uncertainty / per_unit))), 0, max_digits);
    return with_decimals(value / per_unit, decimals) + " ± " + with_decimals(uncertainty / per_unit, decimals) + " " +
           unit;
}

}  // namespace

std::string broken_limit(const LimitState& limit, const std::vector<documents::Measure>& measures) {
    return limit.limit->reason + how_far(limit, measures);
}

std::string why_unmeasured(const std::string& measure, const StepState& state,
                           const std::vector<documents::Measure>& measures) {
    for (std::size_t m = 0; m < measures.size() && m < state.measures.size(); ++m)
        if (measures[m].id == measure && !state.measures[m].value)
            return "`" + measure + "` cannot be measured: " + state.measures[m].why_not;
    return "`" + measure + "` was not measured";
}

std::string missed_goal(const documents::Goal& goal, const StepState& state,
                        const std::vector<documents::Measure>& measures) {
    if (goal.quantity == "entry")
        return state.has_met_bone_still && state.is_released_at_end ? "the thread never met bone"
               : state.has_met_bone_still ? "the tool stood on the bone, but it was not running"
                                          : "the tool never met bone";
    if (goal.quantity == "separated") return "the bone did not come apart";
    if (goal.quantity == "held") return "the piece was never held";
    if (goal.quantity == "moved")
        return missed_bound("the piece was moved ", state.moved, {goal.bound.at_least, {}}, 1, mm_text);
    if (goal.quantity == "removed_volume")
        return missed_bound("removed ", state.removed, goal.bound, 4,
                            [](double value, int digits) { return with_significant_digits(value, "mm3", digits); });
    if (goal.quantity == "signal") {
        const auto signal = std::find_if(state.signals.begin(), state.signals.end(),
                                         [&](const SignalState& s) { return s.signal->id == goal.signal.id; });
        const std::string name = "the signal `" + goal.signal.id + "`";
        if (signal == state.signals.end() || !signal->is_seen) return name + " was never reported";
        const auto text_of = [&](double value, int digits) {
            return with_significant_digits(value, goal.signal.unit, digits);
        };
        if (state.left_depth) return missed_bound(name + " was ", signal->last, goal.bound, 4, text_of);
        const int enough = std::max(distinguishing_digits_of(signal->least, goal.bound, 4, text_of),
                                    distinguishing_digits_of(signal->greatest, goal.bound, 4, text_of));
        return name + " was between " + text_of(signal->least, enough) + " and " + text_of(signal->greatest, enough) +
               bounds_text(goal.bound, [&](double end) { return text_of(end, enough); });
    }
    if (goal.quantity == "measure") {
        for (std::size_t m = 0; m < measures.size() && m < state.measures.size(); ++m)
            if (measures[m].id == goal.measure && state.measures[m].value)
                return missed_bound("`" + goal.measure + "` ", *state.measures[m].value, goal.bound, 1,
                                    [&](double value, int decimals) {
                                        return with_decimals_and_unit(value, measures[m].unit(), decimals);
                                    });
        return why_unmeasured(goal.measure, state, measures);
    }
    return missed_bound("depth ", state.left_depth.value_or(std::max(0.0, state.deepest)), goal.bound, 1, mm_text);
}

std::vector<std::string> undecided(const StepState& state, const std::vector<documents::Measure>& measures) {
    std::vector<std::string> texts;
    const auto add = [&](const std::string& id, const documents::Bound& bound) {
        for (std::size_t m = 0; m < measures.size() && m < state.measures.size(); ++m) {
            const documents::Measure& measure = measures[m];
            const documents::MeasureReading& reading = state.measures[m];
            if (measure.id != id || !reading.value ||
                is_decided(bound, *reading.value, reading.uncertainty, measure.is_signed()))
                continue;
            texts.push_back(
                "undecided, as the bound lies within the uncertainty: `" + id + "` " +
                with_uncertainty(*reading.value, reading.uncertainty, measure.unit()) +
                bounds_text(bound, [&](double end) { return with_decimals_and_unit(end, measure.unit(), 4); }) + ".");
        }
    };
    for (const documents::Goal& goal : state.step->goals)
        if (goal.quantity == "measure") add(goal.measure, goal.bound);
    for (const documents::Limit& limit : state.step->limits)
        if (limit.quantity == "measure") add(limit.measure, limit.bound);
    return texts;
}

}  // namespace kerf::run
