// SPDX-License-Identifier: Apache-2.0
// What happens to a simulation between ticks: another tool, bodies that come, go and grow together, and undo.
#include "core/haptics/simulation.h"

#include <algorithm>
#include <optional>

#include "core/field/bridge.h"
#include "kerf/assert.hpp"

namespace kerf {

namespace {
constexpr std::size_t first_reserve = 512;  // bricks
constexpr std::uint64_t most_behind = 8;    // records that an adoption may lack
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
    channel_count_ = law_channel_count_ = 0;
    last_rate_ = law_wrench_ = Vec6{};
    std::fill(std::begin(notes_), std::end(notes_), 0.0);
    following_.forget();
    coupling_ = Coupling(coupling_.gains(), {0, 0, outline().grip_z});
    coupling_.let_go(hand_.pose(), world_from_tool_);
    guard_.restart();
    begin_with_tool();
}

// ---- undo ---------------------------------------------------------------------------------------------------------

void Simulation::stamp_closed() {
    if (to_stamp_.empty()) {
        is_clear_ = is_clear_ || !is_bone_in_reach(0.0);
        return;
    }
    std::optional<Moment> before;
    if (is_clear_) before = moment();
    for (const auto& record : to_stamp_)
        for (Separation& separation : present_.apply(record, tools_[record.solid].outline.cutting)) waiting_.push_back(std::move(separation));
    if (!before || present_.is_as_in(before->bone)) return;
    is_clear_ = false;
    keep_for_undo(std::move(*before));
}

void Simulation::keep_for_undo(Moment before) {
    if (undo_.size() == most_undo) undo_.erase(undo_.begin());
    undo_.push_back(std::move(before));
    redo_.clear();
}

Simulation::Moment Simulation::moment() {
    Moment now{present_.image(), {}, waiting_};
    for (const auto& body : bodies_) now.places.push_back({body->world_from_body, body->group, body->is_cuttable, body->is_present});
    return now;
}

std::string Simulation::undo() { return exchange(undo_, redo_, "take back"); }
std::string Simulation::redo() { return exchange(redo_, undo_, "do again"); }

std::string Simulation::exchange(std::vector<Moment>& from, std::vector<Moment>& to, const char* what) {
    if (from.empty()) return std::string("there is no cut to ") + what;
    if (is_bone_in_reach(0.0)) return "the tool is not clear of the bone";
    close_all();
    after_tick();
    if (from.empty()) return std::string("there is no cut to ") + what;
    to.push_back(moment());
    go_back_to(from.back());
    from.pop_back();
    return {};
}

void Simulation::go_back_to(const Moment& moment) {
    present_.restore(moment.bone);
    waiting_ = moment.waiting;
    held_.let_go();
    // Records are numbered on: what was taken back stays in the log.
    std::uint64_t next = 0;
    for (const auto& body : bodies_) next = std::max(next, body->tracker.next_sequence());
    bodies_.clear();
    for (std::size_t id = 0; id < moment.places.size(); ++id) {
        const PresentPiece& piece = present_.piece(id);
        CutField field = piece.cut;
        field.reserve(first_reserve);
        bodies_.push_back(std::make_unique<LiveBody>(static_cast<std::uint16_t>(id), *piece.bone, std::move(field), outline().cutting));
        LiveBody& body = *bodies_.back();
        body.world_from_body = moment.places[id].world_from_body;
        body.group = moment.places[id].group;
        body.is_cuttable = moment.places[id].is_cuttable;
        body.is_present = moment.places[id].is_present;
        body.tracker.take_tool(outline().cutting, static_cast<std::uint16_t>(tool_));
        body.tracker.number_from(next);
        body.tracker.restart(body.body_from(world_from_tool_));
    }
    look_around();
}

// ---- bodies -------------------------------------------------------------------------------------------------------

void Simulation::adopt_what_is_due(bool all) {
    const auto is_due = [&] {
        const std::uint64_t at = adoption_ticks_.empty() ? waiting_.front().tick + adoption_delay : adoption_ticks_.front();
        return all || at <= tick_;
    };
    while (!waiting_.empty() && is_due()) {
        if (!adoption_ticks_.empty()) adoption_ticks_.erase(adoption_ticks_.begin());
        Separation separation = std::move(waiting_.front());
        waiting_.erase(waiting_.begin());
        const std::uint64_t through = bodies_[separation.parent]->tracker.next_sequence();
        Adoption adoption = adoption_of(separation, present_, outline().cutting, through);
        const bool is_adopted = adopt(adoption);
        KERF_ASSERT(is_adopted, "in lock-step the present bone holds every record");
        static_cast<void>(is_adopted);
        present_.adopted(separation);
        separations_.push_back(std::move(separation));
    }
}

bool Simulation::adopt(Adoption& adoption) noexcept {
    if (adoption.parent >= bodies_.size() || bodies_.size() + adoption.parts.size() > most_bodies) return false;
    LiveBody& parent = *bodies_[adoption.parent];
    const std::uint64_t next = parent.tracker.next_sequence();
    if (adoption.through + most_behind < next) return false;

    // The last few records, which the parent's tracker still knows, are stamped here; the open stretch goes on in all parts.
    const auto live_on = [&](LiveBody& body, std::uint64_t next_record) {
        for (std::size_t i = 0; i < parent.tracker.recent_count(); ++i)
            if (const CutRecord& record = parent.tracker.recent(i); record.sequence >= adoption.through && record.removes)
                body.committed.stamp(record, tools_[record.solid].outline.cutting);
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

void Simulation::look_around() noexcept {
    view_.place(bodies_, outline().whole, world_from_tool_, held_);
}

void Simulation::place_body(std::size_t body, const Pose& world_from_body) noexcept {
    LiveBody& moved = *bodies_[body];
    moved.world_from_body = world_from_body;
    if (held_.holds(body)) held_.take(bodies_, held_.body(), world_from_tool_);
    moved.tracker.restart(moved.body_from(world_from_tool_));
    look_around();
}

std::string Simulation::insert(const Body& body, const Pose& world_from_body, bool is_cuttable) {
    if (present_.count() >= most_bodies) return "there are " + std::to_string(most_bodies) + " bodies already, which is the most there may be";
    const auto& tissues = bodies_.front()->bone->materials;
    if (is_cuttable && !std::equal(tissues.begin(), tissues.end(), body.materials.begin(), body.materials.end(),
                                   [](const Material& a, const Material& b) { return a.id == b.id; }))
        return "the tissues of `" + body.id + "` are not those of the bone";
    keep_for_undo(moment());
    const std::uint16_t id = present_.add(body);
    bodies_.push_back(std::make_unique<LiveBody>(id, body, CutField(body, first_reserve), outline().cutting));
    LiveBody& live = *bodies_.back();
    live.world_from_body = world_from_body;
    live.is_cuttable = is_cuttable;
    live.tracker.take_tool(outline().cutting, static_cast<std::uint16_t>(tool_));
    live.tracker.restart(live.body_from(world_from_tool_));
    look_around();
    return {};
}

std::string Simulation::subtract(std::size_t tool, const Pose& world_from_tool) {
    close_all();
    after_tick();
    keep_for_undo(moment());
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
        closed_.push_back(record);
        for (Separation& separation : present_.apply(record, tools_[tool].outline.cutting)) waiting_.push_back(std::move(separation));
    }
    return {};
}

std::string Simulation::fuse() {
    if (!held_.is_any()) return "nothing is held";
    const LiveBody& held = *bodies_[held_.body()];
    const CutBone own{held.bone, &present_.cut(held.id)};
    for (const auto& other : bodies_) {
        if (held_.holds(other->id) || !other->is_present || !other->is_cuttable) continue;
        auto bridge = bridge_between(own, {other->bone, &present_.cut(other->id)}, inverse(other->world_from_body) * held.world_from_body);
        if (!bridge) continue;
        grown_.push_back(std::make_unique<Body>(std::move(*bridge)));
        const std::uint16_t from = other->group, to = held.group;
        if (std::string why_not = insert(*grown_.back(), held.world_from_body, true); !why_not.empty()) return why_not;
        bodies_.back()->group = to;
        for (const auto& body : bodies_)
            if (body->group == from) body->group = to;
        held_.take(bodies_, held_.body(), world_from_tool_);
        look_around();
        return {};
    }
    return "no other piece is near enough to what is held: within about " + std::to_string(static_cast<int>(2e3 * clamp_voxels * spacing_)) + " mm";
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
