// SPDX-License-Identifier: Apache-2.0
#include "run/cheats.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "documents/names.h"
#include "documents/read_instruments.h"
#include "kerf/units.hpp"
#include "text/quantity.h"

namespace kerf::run {

namespace {

using namespace literals;
using documents::HandInput;
using documents::Rehearsal;
using documents::Waypoint;

constexpr double above_bone = -5.0_mm;   // where a hand stays outside
constexpr double scratch = 1.0_mm;       // how deep one goes that withdraws at once
constexpr double beside = 5.0_mm;        // off the plan
constexpr double times_faster = 5.0;     // of a hasty hand: feed and push
constexpr double part_begun = 0.6;       // of the depth of the first step that cuts, off the plan
constexpr double part_turned_out = 0.6;  // of the turns that drove an implant in

bool releases(const Waypoint& at) {
    return std::any_of(at.inputs.begin(), at.inputs.end(),
                       [](const HandInput& input) { return input.kind == HandInput::Kind::release; });
}

/// Returns whether any waypoint fulfils a condition.
template <class Condition>
bool any(const Rehearsal& hand, const Condition& condition) {
    return std::any_of(hand.path.begin(), hand.path.end(), condition);
}

const documents::Instrument* instrument_of(const documents::Procedure& procedure, const Waypoint& at) {
    return at.step < procedure.steps.size()
               ? documents::find_id(procedure.instruments, procedure.steps[at.step].instrument)
               : nullptr;
}

/// Returns the drives of the tool that a waypoint's step uses.
const std::vector<ParameterInfo>& drives_at(const documents::Procedure& procedure, const ComponentCatalog& catalog,
                                            const Waypoint& at) {
    static const std::vector<ParameterInfo> none;
    const documents::Instrument* used = instrument_of(procedure, at);
    const ComponentInfo* tool = used != nullptr ? documents::tool_of(*used, catalog) : nullptr;
    return tool != nullptr ? tool->drives : none;
}

void stay(Rehearsal& hand) { hand.path.resize(1); }

void stay_outside(Rehearsal& hand) {
    for (Waypoint& at : hand.path) at.depth = std::min(at.depth, above_bone);
}

void hurry(Rehearsal& hand) {
    const auto harder = [](double push) { return std::min(times_faster * push, documents::hardest_push); };
    hand.feed *= times_faster;
    hand.push = harder(hand.push);
    for (Waypoint& at : hand.path) {
        if (at.speed) *at.speed *= times_faster;
        if (at.push) *at.push = harder(*at.push);
        at.turning *= times_faster;
    }
}

void hammer(Rehearsal& hand) {
    hand.push = documents::hardest_push;
    for (Waypoint& at : hand.path) {
        at.turn = 0.0;
        at.until_torque.reset();
        at.until_event.clear();
        at.push.reset();
    }
}

void withdraw_at_once(Rehearsal& hand) {
    for (Waypoint& at : hand.path) at.depth = std::min(at.depth, scratch);
}

/// Turns each implant out again before it is released.
void back_out(Rehearsal& hand) {
    std::vector<Waypoint> path;
    double turned = 0.0, deepened = 0.0, before = 0.0;
    std::size_t step = hand.path.empty() ? 0 : hand.path.front().step;
    for (Waypoint at : hand.path) {
        if (at.step != step) turned = deepened = 0.0;
        step = at.step;
        if (at.turn > 0.0) {
            turned += at.turn;
            deepened += at.depth - before;
        }
        before = at.depth;
        if (!releases(at) || !(turned > 0.0)) {
            path.push_back(std::move(at));
            continue;
        }
        Waypoint out = at;
        std::erase_if(at.inputs, [](const HandInput& input) { return input.kind == HandInput::Kind::release; });
        out.turn = -part_turned_out * turned;
        out.until_torque.reset();
        out.until_event.clear();
        out.depth = at.depth - part_turned_out * std::max(0.0, deepened);
        path.push_back(std::move(at));
        path.push_back(std::move(out));
    }
    hand.path = std::move(path);
}

/// @param by   [m] off the plan, to either side
void miss(Rehearsal& hand, double by) {
    for (Waypoint& at : hand.path) at.off_plan = by;
}

/// Returns the first waypoint at which a hand may leave the plan and harm bone. Forceps harm none, and a sleeve or the
/// hole of an implant keeps a drill on the plan. An awl has no motor: then it is the first waypoint.
std::size_t first_free_cut(const documents::Procedure& procedure, const ComponentCatalog& catalog,
                           const Rehearsal& hand) {
    bool has_motor = false;
    for (std::size_t i = 0; i < hand.path.size(); ++i) {
        const std::vector<ParameterInfo>& drives = drives_at(procedure, catalog, hand.path[i]);
        if (std::none_of(drives.begin(), drives.end(),
                         [](const ParameterInfo& drive) { return drive.dimension == dimension::frequency; }))
            continue;
        has_motor = true;
        const bool is_hole = procedure.steps[hand.path[i].step].axis.find('.') != std::string::npos;
        if (!is_hole && !instrument_of(procedure, hand.path[i])->guide) return i;
    }
    return has_motor ? hand.path.size() : 0;
}

/// Works off the plan first, less deep than its first free cut needs, and then as planned.
void begin_beside(std::size_t first_cut, Rehearsal& hand) {
    const auto begin = hand.path.begin() + static_cast<std::ptrdiff_t>(first_cut);
    const auto puts_in_place = [](const HandInput& input) {
        return input.kind == HandInput::Kind::place || input.kind == HandInput::Kind::insert;
    };
    std::vector<Waypoint> beside_plan;
    for (auto at = begin; at != hand.path.end() && at->step == begin->step; ++at) {
        Waypoint first = *at;
        first.off_plan = beside;
        if (first.depth > 0.0) first.depth *= part_begun;
        first.turn *= part_begun;
        std::erase_if(first.inputs, [&](const HandInput& input) {
            return input.kind != HandInput::Kind::drive && !puts_in_place(input);
        });
        std::erase_if(at->inputs, puts_in_place);
        beside_plan.push_back(std::move(first));
    }
    hand.path.insert(begin, beside_plan.begin(), beside_plan.end());
}

/// Switches the motor off at each waypoint. Returns whether any tool has one.
bool switch_off(const documents::Procedure& procedure, const ComponentCatalog& catalog, Rehearsal& hand) {
    bool has_any = false;
    for (Waypoint& at : hand.path) {
        std::erase_if(at.inputs, [](const HandInput& input) { return input.kind == HandInput::Kind::drive; });
        for (const ParameterInfo& drive : drives_at(procedure, catalog, at)) {
            at.inputs.insert(at.inputs.begin(), {HandInput::Kind::drive, drive.id, 0.0});
            has_any = true;
        }
    }
    return has_any;
}

}  // namespace

const Rehearsal* find_good_hand(const documents::Procedure& procedure) {
    const auto good = std::find_if(procedure.rehearsals.begin(), procedure.rehearsals.end(),
                                   [](const Rehearsal& one) { return one.expect == "pass" && !one.path.empty(); });
    return good != procedure.rehearsals.end() ? &*good : nullptr;
}

std::vector<Cheat> cheats_of(const documents::Procedure& procedure, const ComponentCatalog& catalog) {
    const Rehearsal* good = find_good_hand(procedure);
    std::vector<Cheat> cheats;
    if (good == nullptr) return cheats;
    const auto add = [&](const char* id, const std::string& strength, const char* why_not, const auto& spoil) {
        Cheat& cheat = cheats.emplace_back(Cheat{id, strength, why_not, *good});
        cheat.rehearsal.id = std::string("cheat:") + id;
        cheat.rehearsal.title = cheat.strength;
        cheat.rehearsal.expect = "incomplete";
        if (cheat.why_not.empty()) spoil(cheat.rehearsal);
    };
    const bool turns = any(*good, [](const Waypoint& at) { return at.turn > 0.0; });
    const bool leaves = turns && any(*good, &releases);
    add("idle", "stays at its first waypoint", "", &stay);
    add("outside",
        "stays " + text::quantity_text(-above_bone, "mm") + " outside the bone, otherwise like `" + good->id + "`", "",
        &stay_outside);
    add("hasty",
        text::quantity_text(times_faster, "") + " times the feed, turns and push, at most " +
            text::quantity_text(documents::hardest_push, "N"),
        "", &hurry);
    add("hammered", "pushes with " + text::quantity_text(documents::hardest_push, "N") + " and does not turn",
        turns ? "" : "no waypoint turns a tool", &hammer);
    Rehearsal off = *good;
    const bool has_motor = switch_off(procedure, catalog, off);
    add("drive-off", "its motors are switched off", has_motor ? "" : "no tool has a drive",
        [&](Rehearsal& hand) { hand.path = off.path; });
    add("withdrawn", "goes " + text::quantity_text(scratch, "mm") + " deep and withdraws", "", &withdraw_at_once);
    add("backed-out",
        "turns each implant out again by " + text::quantity_text(part_turned_out, "%") +
            " of its turns before it is left",
        leaves ? "" : "no waypoint turns and releases an implant", &back_out);
    const std::size_t first_cut = first_free_cut(procedure, catalog, *good);
    const bool begins_on_plan = first_cut == good->path.size();
    const std::string far = text::quantity_text(beside, "mm") + " beside the plan: ";
    add("beside", far + "off its plane, or towards the midline if it has none", "",
        [](Rehearsal& hand) { miss(hand, beside); });
    add("other-side", far + "to the other side", "", [](Rehearsal& hand) { miss(hand, -beside); });
    add("begun-beside",
        "begins " + text::quantity_text(beside, "mm") + " beside the plan, " + text::quantity_text(part_begun, "%") +
            " as deep as its first step that cuts, and then works like `" + good->id + "`",
        begins_on_plan ? "a sleeve or an implant's hole holds every tool that cuts on the plan" : "",
        [&](Rehearsal& hand) { begin_beside(first_cut, hand); });
    return cheats;
}

}  // namespace kerf::run
