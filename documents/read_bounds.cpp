// SPDX-License-Identifier: Apache-2.0
#include "documents/read_bounds.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "documents/names.h"
#include "documents/shapes/shapes.h"
#include "documents/signal_need.h"
#include "text/codes.h"
#include "text/look_alike.h"
#include "text/printable.h"

namespace kerf::documents {
namespace {

/// Reads `{at_least: …, at_most: …}`, the keys that the shape has. Of two keys, one is enough.
/// @param need_of   returns the unit and range for a key; nothing if they are unknown
template <class NeedOf>
void read_bound_values(MapReader& map, const Shape& shape, const std::string& name, NeedOf&& need_of, Bound& bound,
                       Report& report) {
    bool is_bounded = shape.find("at_least") == nullptr || shape.find("at_most") == nullptr;
    const auto read_end = [&](const char* key, std::optional<double>& value) {
        const KeyShape* end = shape.find(key);
        const Node* node = end != nullptr ? map.find(key) : nullptr;
        if (node)
            if (const std::optional<text::QuantityNeed> need = need_of(key))
                value = read_quantity(*node, name + "." + key, *need, report);
        is_bounded |= node != nullptr || (end != nullptr && end->presence == Presence::required);
    };
    read_end("at_least", bound.at_least);
    read_end("at_most", bound.at_most);
    if (!is_bounded && map.is_map())
        report.error(text::Code::empty_bound, map.span(), name + " has no bound. Add `at_least` or `at_most`.");
    if (bound.at_least && bound.at_most && *bound.at_least > *bound.at_most)
        report.error(text::Code::empty_bound, map.span(),
                     name + " has `at_least` above `at_most`, so no value fits. Exchange the two.");
}

/// Returns the signal that `node` names. Reports a name that the law does not declare, and returns null.
const SignalInfo* find_signal(const Node& node, const std::string& id, const ComponentInfo& law, Report& report) {
    std::vector<std::string> known;
    for (const SignalInfo& signal : law.signals) {
        if (signal.id == id) return &signal;
        known.push_back(signal.id);
    }
    refuse_unknown({.code = text::Code::unknown_signal,
                    .span = node.span,
                    .subject = "The signal " + quoted_id(text::excerpt(id, 40)),
                    .word = text::straightened(id),
                    .known = known,
                    .if_none = "the law " + quoted_id(law.id) + " declares none. Use another quantity.",
                    .of = " of " + law.id},
                   report);
    return nullptr;
}

/// Reads `{id: clamp, at_least: 100 N}`. The bounds of an unknown signal have no unit, so they are not read.
void read_signal(MapReader& map, const Shape& shape, const ComponentInfo* law, NamedSignal& signal, Bound& bound,
                 Report& report) {
    const SignalInfo* declared = nullptr;
    if (const Node* node = map.find("id")) {
        const std::string id = read_id(*node, "signal.id", report).value_or("");
        if (!id.empty() && law) declared = find_signal(*node, id, *law, report);
        if (declared || !law) signal.id = id;
    }
    if (declared) {
        signal.index = static_cast<std::size_t>(declared - law->signals.data());
        signal.unit = declared->display_unit;
    }
    read_bound_values(
        map, shape, signal.id.empty() ? "signal" : signal.id,
        [&](const char*) { return declared ? std::optional(need_of(*declared)) : std::nullopt; }, bound, report);
}

/// Reads `{of: gonial_angle_left, at_least: 120 deg}`. The bounds of an unknown measure have no unit, so they are not
/// read.
void read_measure_bound(MapReader& map, const ProcedureContext& reading, std::string& measure, Bound& bound) {
    const Measure* declared = nullptr;
    if (const Node* node = map.find("of")) {
        measure = read_id(*node, "measure.of", reading.report).value_or("");
        const std::vector<std::string> known = ids_of(reading.procedure.measures);
        declared = find_id(reading.procedure.measures, measure);
        const Node* place = reading.document.root.find("measures");
        const bool is_refused_there = place != nullptr && (place->kind != Node::Kind::map || known.empty());
        if (!measure.empty() && declared == nullptr && !is_refused_there)
            refuse_unknown({.code = text::Code::unknown_measure,
                            .span = node->span,
                            .subject = "The measure " + quoted_id(text::excerpt(measure, 40)),
                            .word = text::straightened(measure),
                            .known = known,
                            .if_none = "the procedure has none. Add it under `measures:`."},
                           reading.report);
    }
    read_bound_values(
        map, shapes::measure_bound, measure.empty() ? "measure" : measure,
        [&](const char*) -> std::optional<text::QuantityNeed> {
            if (declared == nullptr) return std::nullopt;
            if (!declared->is_angle()) return shapes::length_of_measure;
            return declared->kind == Measure::Kind::difference ? shapes::angle_of_difference : shapes::angle_of_measure;
        },
        bound, reading.report);
}

/// Reads the bound on the quantity of a goal or limit.
template <class T>
void read_bound(MapReader& map, const Shape& shape, const ComponentInfo* law, const ProcedureContext& reading,
                T& thing) {
    if (thing.quantity == "signal")
        read_signal(map, shape, law, thing.signal, thing.bound, reading.report);
    else if (thing.quantity == "measure")
        read_measure_bound(map, reading, thing.measure, thing.bound);
    else if (!shape.keys.empty())
        read_bound_values(
            map, shape, thing.quantity, [&](const char* key) { return std::optional(map.need_of(key)); }, thing.bound,
            reading.report);
}

/// Reports a goal that has an upper bound alone. Returns whether it does.
bool refuse_upper_bound_alone(const std::string& name, const Node& quantity, Report& report) {
    const Node* upper = quantity.find("at_most");
    if (quantity.find("at_least") != nullptr || upper == nullptr) return false;
    report.error(text::Code::empty_bound, upper->span,
                 "The goal `" + name + "` has an upper bound alone: got at most " + text::excerpt(upper->text, 40) +
                     ", which also holds before the step begins. Write it under `limits:`, or add `at_least`.");
    return true;
}

/// Whether a quantity of 0 is within the bound.
bool holds_at_zero(const Bound& bound) {
    return bound.at_least.value_or(0.0) <= 0.0 && bound.at_most.value_or(0.0) >= 0.0;
}

}  // namespace

Goal read_goal(const Node& item, const ComponentInfo* law, const ProcedureContext& reading) {
    MapReader map(item, shapes::goal, "goal", reading.report);
    Goal goal;
    if (const Node* quantity = map.one_of()) {
        goal.quantity = quantity->key;
        goal.place = reading.document.place(quantity->key_span);
        const Shape& shape = *shapes::goal.find(quantity->key)->value.shape;
        if ((goal.quantity == "depth" || goal.quantity == "signal") &&
            refuse_upper_bound_alone(goal.quantity, *quantity, reading.report))
            return goal;
        MapReader bound(*quantity, shape, quantity->key, reading.report);
        read_bound(bound, shape, law, reading, goal);
        if (goal.quantity == "depth" && goal.bound.at_most && *goal.bound.at_most < 0.0)
            reading.report.error(
                text::Code::empty_bound, quantity->find("at_most")->span,
                "No depth fits this goal: got at most " + quantity->find("at_most")->text +
                    ", but a depth in bone is never below 0 mm. Remove `at_most`: a step ends with the tool "
                    "outside again.");
        else if ((goal.quantity == "depth" || goal.quantity == "signal") && goal.bound.at_least &&
                 holds_at_zero(goal.bound))
            reading.report.error(text::Code::empty_bound, quantity->find("at_least")->span,
                                 "The goal `" + goal.name() + "` holds before the step begins: got at least " +
                                     text::excerpt(quantity->find("at_least")->text, 40) +
                                     ", but it is 0 in air. "
                                     "Write a value above 0.");
        bound.finish();
    }
    map.finish();
    return goal;
}

Limit read_limit(const Node& item, const ComponentInfo* law, const ProcedureContext& reading) {
    MapReader map(item, shapes::limit, "limit", reading.report);
    Limit limit;
    if (const Node* quantity = map.one_of()) {
        limit.quantity = quantity->key;
        limit.place = reading.document.place(quantity->key_span);
        const Shape& shape = *shapes::limit.find(quantity->key)->value.shape;
        MapReader bound(*quantity, shape, quantity->key, reading.report);
        if (const Node* zone = limit.quantity == "clearance" ? bound.find("zone") : nullptr) {
            limit.zone = read_id(*zone, "clearance.zone", reading.report).value_or("");
            if (!limit.zone.empty() && !contains(reading.procedure.needs_zones, limit.zone))
                reading.refuse_undeclared(text::Code::undeclared_zone, *zone, "zone");
        }
        if (limit.quantity == "breach") shapes::breach_bound.fill(bound, limit);
        const auto landmark = [&](const char* key) {
            const Node* name = bound.find(key);
            return name ? reading.landmark(*name, bound.name_of(key)) : std::string();
        };
        if (limit.quantity == "tip_apex" || limit.quantity == "axes_angle") {
            const bool is_apex = limit.quantity == "tip_apex";
            limit.landmark = landmark(is_apex ? "apex" : "of");
            limit.other = landmark(is_apex ? "neck" : "to");
        }
        read_bound(bound, shape, law, reading, limit);
        bound.finish();
    }
    shapes::limit.fill(map, limit);
    map.finish();
    return limit;
}

namespace {

/// A goal or limit of a step, with its node. One that was refused has no node.
struct PlacedBound {
    const Bound* bound = nullptr;
    const Node* node = nullptr;
    std::string quantity, name;
    bool is_goal = false;
};

template <class T>
void place_bounds(const std::vector<T>& things, const Node* list, bool is_goal, std::vector<PlacedBound>& bounds) {
    for (std::size_t i = 0; list && i < things.size() && i < list->children.size(); ++i) {
        const Node* node = list->children[i].find(things[i].quantity);
        if (!node) continue;
        bounds.push_back({&things[i].bound, node, things[i].quantity, things[i].name(), is_goal});
    }
}

/// Reports goals on depth that no order of events meets. A depth is the deepest point of the tip so far, so it never
/// decreases from one goal to the next.
void refuse_goals_apart(const std::vector<PlacedBound>& bounds, Report& report) {
    for (std::size_t later = 0; later < bounds.size(); ++later)
        for (std::size_t earlier = 0; earlier < later; ++earlier) {
            const PlacedBound &first = bounds[earlier], &then = bounds[later];
            if (!first.is_goal || !then.is_goal || first.name != "depth" || then.name != "depth") continue;
            if (!first.bound->at_least || !then.bound->at_most || *first.bound->at_least <= *then.bound->at_most)
                continue;
            const Node *least = first.node->find("at_least"), *most = then.node->find("at_most");
            if (!least || !most) continue;
            report.error(text::Code::contradiction, most->span,
                         "The goals exclude each other: got a depth of at most " + most->text +
                             " after one of at least " + least->text +
                             ", but a depth never decreases within a step. Change one of the two.",
                         {}, report.because(least->span, "the earlier goal is here."));
        }
}

}  // namespace

void refuse_contradictions(const Step& step, const Node& item, Report& report) {
    std::vector<PlacedBound> bounds;
    place_bounds(step.goals, item.find("goals"), true, bounds);
    place_bounds(step.limits, item.find("limits"), false, bounds);
    refuse_goals_apart(bounds, report);
    const auto refuse = [&](const PlacedBound& one, const char* end, const PlacedBound& limit, const char* other_end) {
        const Node *value = one.node->find(end), *limit_value = limit.node->find(other_end);
        if (!value || !limit_value) return;
        const auto words = [](const Node& bound, const char* key) {
            return std::string(key == std::string_view("at_least") ? "at least " : "at most ") + bound.text;
        };
        const std::string got = quoted_id(one.name) + " " + words(*value, end),
                          allowed = words(*limit_value, other_end);
        report.error(text::Code::contradiction, value->span,
                     one.is_goal ? "The goal breaks a limit of its step: got " + got + ", expected " + allowed +
                                       ". Write a goal within the limit, or move the limit."
                                 : "The limits exclude each other: got " + got + ", expected " + allowed +
                                       ". Change one of the two.",
                     {}, report.because(limit_value->span, "the limit is here."));
    };
    for (std::size_t l = 0; l < bounds.size(); ++l) {
        const PlacedBound& limit = bounds[l];
        for (std::size_t b = 0; b < bounds.size() && !limit.is_goal; ++b) {
            const PlacedBound& one = bounds[b];
            if (one.quantity != limit.quantity || one.name != limit.name || (!one.is_goal && b <= l)) continue;
            if (one.bound->at_least && limit.bound->at_most && *one.bound->at_least > *limit.bound->at_most)
                refuse(one, "at_least", limit, "at_most");
            if (one.bound->at_most && limit.bound->at_least && *one.bound->at_most < *limit.bound->at_least)
                refuse(one, "at_most", limit, "at_least");
        }
    }
}

}  // namespace kerf::documents
