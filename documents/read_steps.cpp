// SPDX-License-Identifier: Apache-2.0
#include "documents/read_steps.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "documents/names.h"
#include "documents/read_bounds.h"
#include "documents/read_implants.h"
#include "documents/read_instruments.h"
#include "documents/shapes/shapes.h"
#include "text/codes.h"
#include "text/look_alike.h"
#include "text/printable.h"

namespace kerf::documents {
namespace {

void refuse_instrument(const Node& name, const ProcedureContext& reading) {
    const Node* place = reading.document.root.find("instruments");
    if (place == nullptr || place->kind != Node::Kind::map || place->children.empty()) return;  // reported there
    refuse_unknown({.code = text::Code::unknown_instrument,
                    .span = name.span,
                    .subject = "The instrument " + quoted_id(name.text),
                    .word = text::straightened(name.text),
                    .known = ids_of(reading.procedure.instruments),
                    .reason = reading.report.because(place->key_span, "the instruments are here.")},
                   reading.report);
}

std::string read_axis(const Node& node, const ProcedureContext& reading) {
    std::string axis = read_id(node, "axis", reading.report).value_or("");
    // A landmark has precedence over a hole of the same name.
    if (axis.empty() || contains(reading.procedure.needs_landmarks, axis)) return axis;
    if (const auto hole = named_hole(axis, reading.procedure.implants))
        check_named_hole(node, *hole, *reading.document.root.find("implants"), reading.report);
    else
        reading.refuse_undeclared(text::Code::undeclared_landmark, node, "landmark");
    return axis;
}

/// Returns whether the force of an instrument is known; an unknown one is reported there.
bool has_law(const Instrument& instrument, const ComponentCatalog& catalog) {
    return std::any_of(catalog.begin(), catalog.end(), [&](const ComponentInfo& component) {
        return component.kind == KERF_KIND_FORCE && component.plugin == instrument.force_plugin &&
               component.id == instrument.force;
    });
}

/// `allow:` names events that the step's instrument reports as damage.
std::vector<std::string> read_allowed(const Node& node, const Instrument& instrument, const ProcedureContext& reading) {
    Report& report = reading.report;
    const std::vector<std::string> known = ids_of(instrument.damages);
    std::vector<std::string> allowed;
    for (const Node& item : read_list(node, "allow", report)) {
        const std::string id = read_id(item, "allow", report).value_or("");
        if (id.empty()) continue;
        allowed.push_back(id);
        if (contains(known, id) || !has_law(instrument, reading.catalog)) continue;
        const std::string meant = closest(text::straightened(id), known, report);
        report.error(text::Code::unknown_event, item.span,
                     "The event `" + text::excerpt(id, 60) + "` cannot be allowed: " +
                         (known.empty() ? "nothing that `" + instrument.id + "` reports fails a step. Remove it."
                                        : "expected " + listed(known, id) + "." + or_choose(meant)),
                     meant);
    }
    return allowed;
}

/// What spoils the tool fails the step, unless the step allows it.
void add_damage_limits(const Instrument& instrument, const text::SourcePosition& place, Step& step) {
    for (const EventInfo& event : instrument.damages) {
        if (contains(step.allowed, event.id)) continue;
        Limit& limit = step.limits.emplace_back();
        limit.quantity = "damage";
        limit.event = event.id;
        limit.reason = event.help;
        limit.place = place;
    }
}

}  // namespace

Step read_step(const Node& item, const ProcedureContext& reading) {
    Report& report = reading.report;
    MapReader map(item, shapes::step, item_name(item, "step"), report);
    Step step;
    shapes::step.fill(map, step);
    if (const Node* instrument = map.find("instrument")) {
        step.instrument = read_id(*instrument, "instrument", report).value_or("");
        if (!step.instrument.empty() && find_id(reading.procedure.instruments, step.instrument) == nullptr)
            refuse_instrument(*instrument, reading);
    }
    if (const Node* axis = map.find("axis")) step.axis = read_axis(*axis, reading);
    if (const Node* plane = map.find("plane")) step.plane = reading.landmark(*plane, "plane");
    const Instrument* used = find_id(reading.procedure.instruments, step.instrument);
    const ComponentInfo* law = used != nullptr ? law_of(*used, reading.catalog) : nullptr;
    if (const Node* goals = map.find("goals"))
        for (const Node& goal : read_list(*goals, "goals", report)) step.goals.push_back(read_goal(goal, law, reading));
    if (const Node* limits = map.find("limits"))
        for (const Node& limit : read_list(*limits, "limits", report))
            step.limits.push_back(read_limit(limit, law, reading));
    refuse_contradictions(step, item, report);
    const Node* allow = map.find("allow");
    if (used != nullptr) {
        if (allow) step.allowed = read_allowed(*allow, *used, reading);
        const Node* written = item.find("instrument");
        add_damage_limits(*used, reading.document.place(written ? written->span : item.span), step);
    }
    map.finish();
    return step;
}

}  // namespace kerf::documents
