// SPDX-License-Identifier: Apache-2.0
#include "documents/read_rehearsals.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>
#include <string>

#include "documents/names.h"
#include "documents/read_instruments.h"
#include "documents/shapes/shapes.h"
#include "documents/waypoint_nodes.h"
#include "text/codes.h"
#include "text/look_alike.h"
#include "text/printable.h"

namespace kerf::documents {
namespace {

/// The names by which a rehearsal can expect a limit to break: the zone, the signal, or else the quantity. A goal on
/// depth or on a signal has one, too: an implant may be left otherwise.
struct LimitNames {
    std::vector<std::string> known;
    std::set<std::string> refused;  ///< of limits that are reported already
    bool has_unread = false;        ///< a limit has an unknown quantity: that of any other may be meant

    [[nodiscard]] bool has(const std::string& name) const { return contains(known, name); }
};

bool can_be_lost(const Goal& goal) {
    return goal.quantity == "depth" || (goal.quantity == "signal" && !goal.signal.id.empty());
}

LimitNames limit_names(const ProcedureContext& reading) {
    const Procedure& procedure = reading.procedure;
    LimitNames names;
    const auto is_declared = [&](const std::string& measure) {
        return find_id(procedure.measures, measure) != nullptr;
    };
    for (const Step& step : procedure.steps)
        for (const Limit& limit : step.limits) {
            const bool is_sound = !limit.quantity.empty() && (limit.quantity != "clearance" || !limit.zone.empty()) &&
                                  (limit.quantity != "signal" || !limit.signal.id.empty()) &&
                                  (limit.quantity != "measure" || is_declared(limit.measure)) &&
                                  (limit.zone.empty() || contains(procedure.needs_zones, limit.zone));
            if (limit.quantity.empty()) names.has_unread = true;
            if (is_sound && !names.has(limit.name())) names.known.push_back(limit.name());
        }
    for (const Step& step : procedure.steps)
        for (const Goal& goal : step.goals)
            if (can_be_lost(goal) && !names.has(goal.name())) names.known.push_back(goal.name());
    const Node* steps = reading.document.root.find("steps");
    for (const Node& step : steps != nullptr ? steps->children : std::vector<Node>{})
        if (const Node* limits = step.find("limits"))
            for (const Node& limit : limits->children)
                for (const Node& quantity : limit.children) {
                    const Node *zone = quantity.find("zone"), *signal = quantity.find("id"),
                               *measure = quantity.key == "measure" ? quantity.find("of") : nullptr;
                    names.refused.insert(zone != nullptr      ? zone->text
                                         : signal != nullptr  ? signal->text
                                         : measure != nullptr ? measure->text
                                                              : quantity.key);
                }
    return names;
}

void refuse_limit(const Node& name, const LimitNames& limits, Report& report) {
    if (limits.refused.contains(name.text) || (limits.has_unread && shapes::limit.find(name.text) != nullptr)) return;
    refuse_unknown({.code = text::Code::unknown_limit,
                    .span = name.span,
                    .subject = "The limit " + quoted_id(name.text),
                    .word = text::straightened(name.text),
                    .known = limits.known,
                    .if_none = "no step has a limit. Add one to a step."},
                   report);
}

/// A limit that breaks in a step must be a limit of that step.
void refuse_other_step(const Node& name, const Step& step, const std::string& limit, const ProcedureContext& reading) {
    const auto is_unread = [&](const Limit& l) {
        return l.quantity.empty() || (!l.zone.empty() && !contains(reading.procedure.needs_zones, l.zone));
    };
    if (std::any_of(step.limits.begin(), step.limits.end(), is_unread)) return;  // reported there
    if (std::any_of(step.limits.begin(), step.limits.end(), [&](const Limit& l) { return l.name() == limit; })) return;
    if (std::any_of(step.goals.begin(), step.goals.end(),
                    [&](const Goal& goal) { return can_be_lost(goal) && goal.name() == limit; }))
        return;
    reading.report.error(text::Code::unknown_limit, name.span,
                         "The step " + quoted_id(step.id) + " has no limit " + quoted_id(limit) +
                             ". Name a step that has it, or add the limit.");
}

bool has_unknown_key(const Node& procedure) {
    return std::any_of(procedure.children.begin(), procedure.children.end(),
                       [](const Node& child) { return shapes::procedure.find(child.key) == nullptr; });
}

/// Reads `expect: pass`, `expect: incomplete`, or `expect: {fail: canal, step: drill}`.
void read_expectation(const Node& node, const LimitNames& limits, const ProcedureContext& reading,
                      Rehearsal& rehearsal) {
    Report& report = reading.report;
    if (node.kind == Node::Kind::map) {
        MapReader map(node, shapes::expectation, "expect", report);
        rehearsal.expect = "fail";
        if (const Node* limit = map.find("fail")) {
            rehearsal.expect_limit = read_id(*limit, "expect.fail", report).value_or("");
            if (!rehearsal.expect_limit.empty() && !limits.has(rehearsal.expect_limit))
                refuse_limit(*limit, limits, report);
        }
        shapes::expectation.fill(map, rehearsal);
        if (const Node* step = map.find("step")) {
            rehearsal.expect_step = read_id(*step, "expect.step", report).value_or("");
            const Step* found = find_id(reading.procedure.steps, rehearsal.expect_step);
            if (!rehearsal.expect_step.empty() && found == nullptr)
                reading.refuse_step(*step);
            else if (found != nullptr && limits.has(rehearsal.expect_limit))
                refuse_other_step(*step, *found, rehearsal.expect_limit, reading);
        }
        map.finish();
        return;
    }
    const std::optional<std::string> text = read_text(node, "expect", report);
    if (!text) return;
    rehearsal.expect = *text;
    if (*text == "pass" || *text == "incomplete") return;
    const std::string meant = closest(text::straightened(*text), {"pass", "incomplete"}, report);
    report.error(text::Code::unknown_word, node.span,
                 "expect is unknown: got `" + text::excerpt(*text, 40) +
                     "`, expected `pass`, `incomplete`, or `{fail: …}` with the limit that breaks." + or_choose(meant),
                 meant);
}

/// Reads `insert: plate` or `place: plate`.
void read_implant_name(const Node& node, const ProcedureContext& reading, Waypoint& at) {
    const std::string id = read_id(node, "waypoint." + node.key, reading.report).value_or("");
    if (id.empty()) return;
    const bool is_placed = node.key == "place";
    at.inputs.push_back({is_placed ? HandInput::Kind::place : HandInput::Kind::insert, id});
    const Implant* implant = find_id(reading.procedure.implants, id);
    if (implant == nullptr)
        refuse_unknown({.code = text::Code::unknown_implant,
                        .span = node.span,
                        .subject = "The implant " + quoted_id(node.text),
                        .word = text::straightened(node.text),
                        .known = ids_of(reading.procedure.implants),
                        .if_none = "the procedure has none. Add one under `implants:`."},
                       reading.report);
    else if (is_placed && !implant->place)
        reading.report.error(text::Code::missing_key, node.span,
                             "The implant " + quoted_id(id) +
                                 " has no planned pose. Add `place: {axis: …, up: 0 0 1}` to it, or write `insert: " +
                                 id + "`, which puts it at the tool.");
}

/// Reads `until: {torque: 2 N*m}` or `until: {event: implant.head_contact}`.
/// @param instrument   null: it is unknown
void read_until(const Node& node, const Instrument* instrument, const ProcedureContext& reading, Waypoint& at) {
    const Node* event = nullptr;
    read_map(node, shapes::until, "waypoint.turn.until", at, reading.report,
             [&](MapReader& map) { event = map.find("event"); });
    const ComponentInfo* law = instrument != nullptr ? law_of(*instrument, reading.catalog) : nullptr;
    if (at.until_event.empty() || law == nullptr) return;
    const std::vector<std::string> known = ids_of(law->events);
    if (contains(known, at.until_event)) return;
    refuse_unknown(
        {.code = text::Code::unknown_event,
         .span = event->span,
         .subject = "The event " + quoted_id(text::excerpt(at.until_event, 60)),
         .word = text::straightened(at.until_event),
         .known = known,
         .if_none = "the force of " + quoted_id(instrument->id) + " reports none. Write `until: {torque: 2 N*m}`.",
         .of = " of " + quoted_id(instrument->id)},
        reading.report);
}

/// @param step   of the waypoint before
Waypoint read_waypoint(const Node& point, std::size_t step, const ProcedureContext& reading) {
    const std::vector<Step>& steps = reading.procedure.steps;
    MapReader waypoint(point, shapes::waypoint, "waypoint", reading.report);
    Waypoint at;
    at.step = step;
    if (const Node* name = waypoint.find("step"))
        if (const std::string id = read_id(*name, "waypoint.step", reading.report).value_or(""); !id.empty()) {
            if (const Step* found = find_id(steps, id))
                at.step = static_cast<std::size_t>(found - steps.data());
            else
                reading.refuse_step(*name);
        }
    shapes::waypoint.fill(waypoint, at);
    const Instrument* instrument =
        at.step < steps.size() ? find_id(reading.procedure.instruments, steps[at.step].instrument) : nullptr;
    if (const Node* turn = waypoint.find("turn"))
        read_map(*turn, shapes::turn, "waypoint.turn", at, reading.report, [&](MapReader& map) {
            if (const Node* until = map.find("until")) read_until(*until, instrument, reading, at);
        });
    if (const Node* drives = waypoint.find("drives"); drives && instrument != nullptr)
        at.inputs = read_inputs(*drives, *instrument, reading.catalog, reading.report);
    for (const char* key : {"insert", "place"})
        if (const Node* implant = waypoint.find(key)) read_implant_name(*implant, reading, at);
    if (const std::string word = waypoint.word("do"); word == "image")
        at.inputs.push_back({HandInput::Kind::image});  // AP
    else if (const auto input = hand_input(word))
        at.inputs.push_back(*input);
    waypoint.finish();
    return at;
}

/// The waypoints of rehearsals, and of the paths that they follow.
class PathReader {
public:
    explicit PathReader(const ProcedureContext& reading) : reading_(reading), report_(reading.report) {}

    /// Reads `paths` by themselves: each error is reported, even in a path that no rehearsal follows.
    void read_paths(const Node& paths) {
        if (!is_kind(paths, Node::Kind::map, "paths", report_)) return;
        for (const Node& path : paths.children) {
            if (read_key(path, "A path's name", report_)) names_.push_back(path.key);
            // The step before is that of whoever follows; without one, no drive is checked here.
            std::size_t step = reading_.procedure.steps.size();
            for (const Node& point : read_list(path, path.key, report_)) {
                if (const Node* name = point.find("follow"))
                    report_.error(text::Code::unknown_key, name->key_span,
                                  "The path " + quoted_id(text::excerpt(path.key, 40)) +
                                      " follows another, expected waypoints. Write them here, or follow both paths in "
                                      "the rehearsal.");
                else
                    step = read_waypoint(point, step, reading_).step;
            }
        }
        place_ = &paths;
    }

    std::vector<Waypoint> read(const Node& path) {
        std::size_t own = 0;
        bool is_known = true;
        for (const Node& item : read_list(path, "path", report_))
            if (item.find("follow") != nullptr)
                is_known &= check_name(item);
            else
                ++own;
        std::vector<Waypoint> waypoints;
        if (followed_ >= max_followed) return waypoints;  // reported already
        const std::vector<const Node*> nodes = waypoint_nodes(reading_.document, &path);
        followed_ += nodes.size() - own;
        if (followed_ >= max_followed) {
            report_.error(text::Code::out_of_range, path.key_span,
                          "The rehearsals follow too many waypoints: got " + std::to_string(max_followed) +
                              " or more up to here, expected fewer. Write shorter paths, or follow them less often.");
            return waypoints;
        }
        for (const Node* node : nodes)
            waypoints.push_back(read_waypoint(*node, waypoints.empty() ? 0 : waypoints.back().step, reading_));
        if (!is_known) waypoints.clear();  // what is left of it leads elsewhere: nothing more is said of it
        return waypoints;
    }

    void warn_of_unused() {
        if (!std::all_of(used_.begin(), used_.end(), [&](const std::string& id) { return contains(names_, id); }))
            return;  // one of these may be meant
        for (const Node& path : place_ != nullptr ? place_->children : std::vector<Node>{})
            if (contains(names_, path.key) && !used_.contains(path.key))
                report_.warning(text::Code::unused_path, path.key_span,
                                "The path " + quoted_id(text::excerpt(path.key, 40)) +
                                    " is not followed by any rehearsal. Remove it, or follow it in one.");
    }

private:
    /// `{follow: NAME}`. Returns whether there is such a path.
    bool check_name(const Node& item) {
        MapReader map(item, shapes::follow, "waypoint", report_);
        const Node* name = map.find("follow");
        const std::string id = read_id(*name, "waypoint.follow", report_).value_or("");
        map.finish();
        used_.insert(id);
        const Node* paths = reading_.document.root.find("paths");
        if (contains(names_, id)) return true;
        if (id.empty() || (paths != nullptr && place_ == nullptr)) return false;
        if (paths == nullptr && has_unknown_key(reading_.document.root)) return false;  // most likely meant as `paths`
        std::optional<text::Reason> reason;
        if (place_ != nullptr) reason = report_.because(place_->key_span, "the paths are here.");
        refuse_unknown({.code = text::Code::unknown_path,
                        .span = name->span,
                        .subject = "The path " + quoted_id(id),
                        .word = text::straightened(id),
                        .known = names_,
                        .if_none = "the procedure has none. Add it under `paths:`.",
                        .reason = reason},
                       report_);
        return false;
    }

    const ProcedureContext& reading_;
    Report& report_;
    const Node* place_ = nullptr;  ///< of `paths`; null: there are none
    std::vector<std::string> names_;
    std::set<std::string> used_;
    std::size_t followed_ = 0;  ///< waypoints of `paths`, in all rehearsals
};

Rehearsal read_rehearsal(const Node& item, const LimitNames& limits, const ProcedureContext& reading,
                         PathReader& paths) {
    Rehearsal rehearsal;
    MapReader map(item, shapes::rehearsal, item_name(item, "rehearsal"), reading.report);
    shapes::rehearsal.fill(map, rehearsal);
    if (const Node* expect = map.find("expect")) read_expectation(*expect, limits, reading, rehearsal);
    if (const Node* path = map.find("path")) rehearsal.path = paths.read(*path);
    map.finish();
    return rehearsal;
}

}  // namespace

std::vector<Rehearsal> read_rehearsals(const Node* paths, const Node* rehearsals, const ProcedureContext& reading) {
    std::vector<Rehearsal> read;
    PathReader reader(reading);
    if (paths != nullptr) reader.read_paths(*paths);
    if (rehearsals == nullptr) return read;
    const LimitNames limits = limit_names(reading);
    UniqueIds ids("rehearsal");
    for (const Node& item : read_list(*rehearsals, "rehearsals", reading.report)) {
        read.push_back(read_rehearsal(item, limits, reading, reader));
        ids.add_own(read.back().id, item, reading.report);
    }
    reader.warn_of_unused();
    return read;
}

}  // namespace kerf::documents
