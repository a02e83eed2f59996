// SPDX-License-Identifier: Apache-2.0
// Changes of bodies between ticks.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "core/haptics/loop/loop_bodies.h"
#include "kerf/assert.hpp"

namespace kerf {

namespace {

constexpr std::size_t max_missing = 8;  // records that one field of an offer may lack
static_assert(CutTracker::recent_capacity > max_missing);

/// The bone-removing records of a body from sequence number `through` on. A field made before them lacks them.
struct MissingRecords {
    std::array<const CutRecord*, max_missing> record{};
    std::size_t count = 0;
    bool is_too_many = false;

    MissingRecords(const CutTracker& tracker, std::uint64_t through) noexcept {
        for (std::size_t i = 0; i < tracker.recent_count(); ++i) {
            const CutRecord& recent = tracker.recent(i);
            if (recent.sequence < through) continue;
            is_too_many = count == max_missing;
            if (is_too_many) return;
            record[count++] = &recent;
        }
    }
};

}  // namespace

BodyStates LoopBodies::body_states() const noexcept {
    BodyStates body_states;
    body_states.count = bodies_.size();
    body_states.threads = threads_;
    body_states.knows_threads = true;
    for (std::size_t b = 0; b < bodies_.size(); ++b)
        body_states.of[b] = {bodies_[b]->world_from_body, bodies_[b]->group, bodies_[b]->is_cuttable,
                             bodies_[b]->is_present};
    return body_states;
}

std::uint64_t LoopBodies::next_sequence() const noexcept {
    std::uint64_t next = 0;
    for (const auto& body : bodies_) next = std::max(next, body->tracker.next_sequence());
    return next;
}

bool LoopBodies::take(Offer& offer, const ToolNow& tool) noexcept {
    KERF_ASSERT(offer.is_any(), "the offer contains a change");
    return offer.is_history_change() ? take_turn(offer, tool) : take_change(offer, tool);
}

Takeover LoopBodies::can_take(const Offer& offer, const ToolNow& tool) const noexcept {
    if (offer.is_history_change()) {
        if (is_in_reach(tool, 0.0)) return Takeover::in_bone;
        const bool is_open = std::any_of(bodies_.begin(), bodies_.end(), [](const auto& body) {
            return body->tracker.solid_count() > body->tracker.pending_count();
        });
        if (is_open) return Takeover::not_yet;  // closing that stretch would remove bone
        return offer.removing == removing_ ? Takeover::possible : Takeover::outdated;
    }
    const bool is_outdated = std::any_of(offer.made.begin(), offer.made.end(), [&](const Offer::NewBody& made) {
        if (made.body == nullptr || !made.follows) return false;
        const MissingRecords missing(bodies_[*made.follows]->tracker, made.through);
        return missing.is_too_many || missing.count == max_missing;  // the open stretch may become one more
    });
    return is_outdated ? Takeover::outdated : Takeover::possible;
}

/// Takes over an undo or redo: replaces all bodies by those of a step in the history. Returns as `take`.
bool LoopBodies::take_turn(Offer& offer, const ToolNow& tool) noexcept {
    if (is_in_reach(tool, 0.0)) return false;
    close_stretches(tool.tick);
    if (offer.removing != removing_) return false;
    const std::uint64_t next = next_sequence();  // undone records stay in the log, so numbers continue
    for (std::size_t id = 0; id < offer.body_states.count; ++id) {
        start_body(*offer.made[id].body, offer.body_states.of[id], tool);
        offer.made[id].body->tracker.set_next_sequence(next);
    }
    exchange_bodies(offer);
    if (offer.body_states.knows_threads) threads_ = offer.body_states.threads;
    held_.release();
    update_view(tool);
    return true;
}

/// Takes over any other change: replaces bodies that continue, and adds new ones. Returns as `take`.
bool LoopBodies::take_change(Offer& offer, const ToolNow& tool) noexcept {
    if (!stamp_missing(offer, tool.tools)) return false;
    continue_bodies(offer);
    if (offer.change == Offer::Change::insertion || offer.change == Offer::Change::fusion) {
        const std::size_t last = offer.body_states.count - 1;
        KERF_ASSERT(last == bodies_.size(), "the loop has every older body");
        start_body(*offer.made[last].body, offer.body_states.of[last], tool);
    }
    if (offer.change == Offer::Change::committed)
        for (const auto& body : bodies_)
            if (LiveBody* made = offer.made[body->id].body.get()) {
                made->low = body->low;  // as before, so that a loop that commits by itself has the same bits
                made->high = body->high;
            }
    const bool is_held_changed = std::any_of(bodies_.begin(), bodies_.end(), [&](const auto& body) {
        return offer.made[body->id].body != nullptr && held_.contains(body->id);
    });
    exchange_bodies(offer);
    if (is_held_changed) held_.forget_points();
    if (offer.change == Offer::Change::fusion) {
        for (const auto& body : bodies_) body->group = offer.body_states.of[body->id].group;
        held_.take(bodies_, held_.body(), tool.world_from_tool);
    }
    if (offer.change == Offer::Change::subtraction) add_subtracted(offer, tool.tick);
    update_view(tool);
    return true;
}

/// Stamps on each offered field the records that it lacks, read from the trackers. Returns false and stamps nothing if
/// a field lacks more than `max_missing`.
bool LoopBodies::stamp_missing(const Offer& offer, const LoopTools& tools) noexcept {
    const auto for_each = [&](const auto& use) {
        for (const Offer::NewBody& made : offer.made)
            if (made.body != nullptr && made.follows)
                if (!use(made, MissingRecords(bodies_[*made.follows]->tracker, made.through))) return false;
        return true;
    };
    if (!for_each([](const Offer::NewBody&, const MissingRecords& missing) { return !missing.is_too_many; }))
        return false;
    return for_each([&](const Offer::NewBody& made, const MissingRecords& missing) {
        for (std::size_t i = 0; i < missing.count; ++i)
            made.body->committed.stamp(*missing.record[i], tools.solid(missing.record[i]->solid));
        return true;
    });
}

/// Gives each offered body the pose, presence, threads and open stretch of the body that it follows.
void LoopBodies::continue_bodies(const Offer& offer) noexcept {
    for (const Offer::NewBody& made : offer.made) {
        if (made.body == nullptr || !made.follows) continue;
        const LiveBody& before = *bodies_[*made.follows];
        made.body->world_from_body = before.world_from_body;
        made.body->is_present = before.is_present;
        const bool is_same = made.body->id == before.id;
        if (is_same)
            made.body->group = before.group;
        else
            threads_.inherit(before.id, made.body->id);
        made.body->tracker.continue_from(before.tracker, is_same ? before.tracker.next_sequence() : 0);
    }
}

void LoopBodies::start_body(LiveBody& body, const BodyState& body_state, const ToolNow& tool) const noexcept {
    body.world_from_body = body_state.world_from_body;
    body.group = body_state.group;
    body.is_cuttable = body_state.is_cuttable;
    body.is_present = body_state.is_present;
    body.tracker.take_tool(tool.outline().cutting, static_cast<std::uint16_t>(tool.tools.in_hand()));
    body.tracker.restart(body.body_from(tool.world_from_tool));
}

/// Moves the offered bodies into the loop, and the replaced and removed ones into the offer.
void LoopBodies::exchange_bodies(Offer& offer) noexcept {
    while (bodies_.size() < offer.body_states.count) bodies_.push_back(nullptr);
    const bool has_fewer = offer.is_history_change() && offer.body_states.count < bodies_.size();
    for (std::size_t id = 0; id < bodies_.size(); ++id)
        if (offer.made[id].body != nullptr || (has_fewer && id >= offer.body_states.count))
            std::swap(bodies_[id], offer.made[id].body);
    if (has_fewer) bodies_.resize(offer.body_states.count);
}

void LoopBodies::add_subtracted(Offer& offer, std::uint64_t tick) noexcept {
    for (CutRecord& record : offer.subtracted) {
        CutTracker& tracker = bodies_[record.body]->tracker;
        record.sequence = tracker.next_sequence();
        record.tick = tick;
        tracker.set_next_sequence(record.sequence + 1);
        closed_.push_back(record);
    }
    removing_ += offer.subtracted.size();
}

void LoopBodies::update_view(const ToolNow& tool) noexcept {
    view_.place(bodies_, tool.outline().whole, tool.world_from_tool, held_);
}

void LoopBodies::place(std::size_t body, const Pose& world_from_body, const ToolNow& tool) noexcept {
    LiveBody& moved = *bodies_[body];
    moved.world_from_body = world_from_body;
    if (held_.contains(body)) held_.take(bodies_, held_.body(), tool.world_from_tool);
    moved.tracker.restart(moved.body_from(tool.world_from_tool));
    update_view(tool);
}

void LoopBodies::show(std::size_t body, bool is_present, const ToolNow& tool) noexcept {
    bodies_[body]->is_present = is_present;
    if (held_.contains(body) && !is_present) held_.release();
    update_view(tool);
}

void LoopBodies::remove_held(const ToolNow& tool) noexcept {
    for (const auto& body : bodies_) body->is_present = body->is_present && !held_.contains(body->id);
    held_.release();
    update_view(tool);
}

}  // namespace kerf
