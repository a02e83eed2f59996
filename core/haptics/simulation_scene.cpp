// SPDX-License-Identifier: Apache-2.0
// What happens to a simulation between ticks: another tool, bodies that come, go and grow together, and undo.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/field/bridge.h"
#include "core/haptics/simulation.h"
#include "kerf/assert.hpp"

namespace kerf {

namespace {
constexpr std::size_t most_behind = 8;  // records that an adoption may lack
}  // namespace

void Simulation::take_tool(std::size_t tool) {
    if (tool == tool_) return;
    close_all();
    after_tick();
    tool_ = tool;
    for (const auto& body : bodies_) {
        body->tracker.flush();
        body->tracker.take_tool(outline().cutting, static_cast<std::uint16_t>(tool));
    }
    held_.let_go();
    law_ = {};
    last_rate_ = Vec6{};
    following_.forget();
    coupling_ = Coupling(coupling_.gains(), outline().handling);
    coupling_.let_go(hand_.pose(), world_from_tool_);
    guard_.restart();
    begin_with_tool();
}

// ---- undo ---------------------------------------------------------------------------------------------------------

Placings Simulation::placings() const noexcept {
    Placings placings;
    placings.count = bodies_.size();
    for (std::size_t b = 0; b < bodies_.size(); ++b)
        placings.of[b] = {bodies_[b]->world_from_body, bodies_[b]->group, bodies_[b]->is_cuttable,
                          bodies_[b]->is_present};
    return placings;
}

std::string Simulation::turn_back(Turn turn) {
    if (!is_clear_of_bone()) return "the tool is not clear of the bone";
    close_all();
    after_tick();
    scene_.leave_bone();
    if (!scene_.can(turn)) return turn == Turn::undo ? "there is no cut to take back" : "there is no cut to do again";
    Restoration restoration = scene_.restoration(turn);
    scene_.go(turn, placings());
    exchange_bodies(restoration);
    return {};
}

bool Simulation::go_to(Restoration& restoration) noexcept {
    if (!is_clear_of_bone()) return false;
    close_all();
    if (restoration.records != removing_) return false;
    exchange_bodies(restoration);
    return true;
}

void Simulation::exchange_bodies(Restoration& restoration) noexcept {
    // Records are numbered on: what was taken back stays in the log.
    const std::uint64_t next = next_sequence();
    std::swap(bodies_, restoration.bodies);
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        LiveBody& body = *bodies_[b];
        const Placing& placing = restoration.placings.of[b];
        body.world_from_body = placing.world_from_body;
        body.group = placing.group;
        body.is_cuttable = placing.is_cuttable;
        body.is_present = placing.is_present;
        body.tracker.take_tool(outline().cutting, static_cast<std::uint16_t>(tool_));
        body.tracker.number_from(next);
        body.tracker.restart(body.body_from(world_from_tool_));
    }
    held_.let_go();
    look_around();
}

std::uint64_t Simulation::next_sequence() const noexcept {
    std::uint64_t next = 0;
    for (const auto& body : bodies_) next = std::max(next, body->tracker.next_sequence());
    return next;
}

// ---- bodies -------------------------------------------------------------------------------------------------------

void Simulation::adopt_what_is_due(bool all) {
    const auto& waiting = scene_.waiting();
    const auto is_due = [&] {
        if (all) return true;
        if (!adoption_ticks_) return waiting.front().tick + adoption_delay <= tick_;
        return !adoption_ticks_->empty() && adoption_ticks_->front() <= tick_;
    };
    while (!waiting.empty() && is_due()) {
        if (adoption_ticks_ && !adoption_ticks_->empty()) adoption_ticks_->erase(adoption_ticks_->begin());
        Adoption adoption = scene_.adoption(bodies_[waiting.front().parent]->tracker.next_sequence());
        const bool is_adopted = adopt(adoption);
        KERF_ASSERT(is_adopted, "in lock-step the present bone holds every record");
        static_cast<void>(is_adopted);
        separations_.push_back(scene_.take_adopted());
    }
}

bool Simulation::adopt(Adoption& adoption) noexcept {
    if (adoption.parent >= bodies_.size() || bodies_.size() + adoption.parts.size() > most_bodies) return false;
    LiveBody& parent = *bodies_[adoption.parent];
    const std::uint64_t next = parent.tracker.next_sequence();
    std::array<const CutRecord*, most_behind> lacking{};
    std::size_t lacking_count = 0;
    for (std::size_t i = 0; i < parent.tracker.recent_count(); ++i) {
        const CutRecord& record = parent.tracker.recent(i);
        if (record.sequence < adoption.through) continue;
        if (lacking_count == most_behind) return false;
        lacking[lacking_count++] = &record;
    }

    // The last few records, which the parent's tracker still knows, are stamped here; the open stretch goes on in all
    // parts.
    static_assert(CutTracker::recent_capacity > most_behind);
    const auto live_on = [&](LiveBody& body, std::uint64_t next_record) {
        for (std::size_t i = 0; i < lacking_count; ++i)
            body.committed.stamp(*lacking[i], tools_[lacking[i]->solid].outline.cutting);
        body.world_from_body = parent.world_from_body;
        body.is_present = parent.is_present;
        body.tracker.go_on_from(parent.tracker, next_record);
    };
    live_on(*adoption.renewed, next);
    adoption.renewed->group = parent.group;
    for (auto& part : adoption.parts) {
        live_on(*part, 0);
        bodies_.push_back(std::move(part));
    }
    std::swap(bodies_[adoption.parent], adoption.renewed);
    if (held_.holds(adoption.parent)) held_.forget_points();
    look_around();
    return true;
}

void Simulation::look_around() noexcept { view_.place(bodies_, outline().whole, world_from_tool_, held_); }

void Simulation::place_body(std::size_t body, const Pose& world_from_body) noexcept {
    LiveBody& moved = *bodies_[body];
    moved.world_from_body = world_from_body;
    if (held_.holds(body)) held_.take(bodies_, held_.body(), world_from_tool_);
    moved.tracker.restart(moved.body_from(world_from_tool_));
    look_around();
}

std::string Simulation::insert(const Body& body, const Pose& world_from_body, bool is_cuttable) {
    if (std::string why_not = why_no_more_bodies(); !why_not.empty()) return why_not;
    const auto& tissues = bodies_.front()->bone->materials;
    if (is_cuttable && !std::equal(tissues.begin(), tissues.end(), body.materials.begin(), body.materials.end(),
                                   [](const Material& a, const Material& b) { return a.id == b.id; }))
        return "the tissues of `" + body.id + "` are not those of the bone";
    scene_.keep_for_undo(placings());
    const std::uint16_t id = present().add(body);
    bodies_.push_back(std::make_unique<LiveBody>(id, body, CutField(body, live_reserve), outline().cutting));
    LiveBody& live = *bodies_.back();
    live.world_from_body = world_from_body;
    live.is_cuttable = is_cuttable;
    live.tracker.take_tool(outline().cutting, static_cast<std::uint16_t>(tool_));
    live.tracker.restart(live.body_from(world_from_tool_));
    look_around();
    return {};
}

void Simulation::subtract(std::size_t tool, const Pose& world_from_tool) {
    close_all();
    after_tick();
    std::vector<CutRecord> records;
    for (const auto& body : bodies_) {
        if (!body->is_present || !body->is_cuttable) continue;
        CutRecord record;
        record.sequence = body->tracker.next_sequence();
        record.tick = tick_;
        record.body = body->id;
        record.solid = static_cast<std::uint16_t>(tool);
        record.from = record.to = body->body_from(world_from_tool);
        body->tracker.number_from(record.sequence + 1);
        body->committed.stamp(record, tools_[tool].outline.cutting);
        records.push_back(record);
    }
    removing_ += records.size();
    closed_.insert(closed_.end(), records.begin(), records.end());
    scene_.leave_bone();
    scene_.apply(records, placings());
    scene_.leave_bone();  // a change of its own
}

std::string Simulation::why_no_more_bodies() const {
    return present().count() < most_bodies
               ? std::string{}
               : "there are " + std::to_string(most_bodies) + " bodies already, which is the most there may be";
}

std::string Simulation::fuse() {
    if (!held_.is_any()) return "nothing is held";
    if (std::string why_not = why_no_more_bodies(); !why_not.empty()) return why_not;
    const LiveBody& held = *bodies_[held_.body()];
    std::optional<Bridge> nearest;
    std::uint16_t beyond = 0;  // the group of what it leads to
    for (const auto& other : bodies_) {
        if (held_.holds(other->id) || !other->is_present || !other->is_cuttable) continue;
        auto bridge = bridge_between({held.bone, &exact(held.id)}, {other->bone, &exact(other->id)},
                                     inverse(other->world_from_body) * held.world_from_body);
        if (!bridge || (nearest && nearest->span <= bridge->span)) continue;
        nearest = std::move(bridge);
        beyond = other->group;
    }
    if (!nearest)
        return "no other piece is near enough to what is held: within about " +
               std::to_string(static_cast<int>(2e3 * clamp_voxels * spacing_)) + " mm";
    grown_.push_back(std::make_unique<Body>(std::move(nearest->bone)));
    const std::uint16_t group = held.group;
    if (std::string why_not = insert(*grown_.back(), held.world_from_body, true); !why_not.empty()) return why_not;
    bodies_.back()->group = group;
    for (const auto& body : bodies_)
        if (body->group == beyond) body->group = group;
    held_.take(bodies_, held_.body(), world_from_tool_);
    look_around();
    return {};
}

void Simulation::show_body(std::size_t body, bool is_present) noexcept {
    bodies_[body]->is_present = is_present;
    if (held_.holds(body) && !is_present) held_.let_go();
    look_around();
}

void Simulation::remove_held() noexcept {
    for (const auto& body : bodies_) body->is_present = body->is_present && !held_.holds(body->id);
    held_.let_go();
    look_around();
}

}  // namespace kerf
