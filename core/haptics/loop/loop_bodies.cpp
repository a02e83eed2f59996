// SPDX-License-Identifier: Apache-2.0
// What happens to a loop between ticks: another tool, and changes of its bodies.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "core/haptics/loop/haptic_loop.h"
#include "kerf/assert.hpp"

namespace kerf {

namespace {

constexpr std::size_t most_lacking = 8;  // records that an offer may lack
static_assert(CutTracker::recent_capacity > most_lacking);

/// Records of a body that remove bone and that a field before `through` lacks.
struct Lacking {
    std::array<const CutRecord*, most_lacking> record{};
    std::size_t count = 0;
    bool is_too_much = false;

    Lacking(const CutTracker& tracker, std::uint64_t through) noexcept {
        for (std::size_t i = 0; i < tracker.recent_count(); ++i) {
            const CutRecord& recent = tracker.recent(i);
            if (recent.sequence < through) continue;
            is_too_much = count == most_lacking;
            if (is_too_much) return;
            record[count++] = &recent;
        }
    }
};

}  // namespace

void HapticLoop::take_tool(std::size_t tool, double back) {
    tool_ = tool;
    world_from_tool_ = world_from_tool_ * Pose{{0, 0, -back}, {1, 0, 0, 0}};
    flush();
    for (const auto& body : bodies_) body->tracker.take_tool(outline().cutting, static_cast<std::uint16_t>(tool));
    held_.let_go();
    law_ = {};
    last_rate_ = Vec6{};
    following_.forget();
    coupling_ = Coupling(coupling_.gains(), outline().handling);
    coupling_.let_go(hand_.pose(), world_from_tool_);
    is_new_tool_ = true;
    guard_.serve(port_of_shaft(coupling_));
    guard_.restart();
    begin_with_tool();
}

// ---- changes of bodies --------------------------------------------------------------------------------------------

Placings HapticLoop::placings() const noexcept {
    Placings placings;
    placings.count = bodies_.size();
    placings.threads = threads_;
    placings.knows_threads = true;
    for (std::size_t b = 0; b < bodies_.size(); ++b)
        placings.of[b] = {bodies_[b]->world_from_body, bodies_[b]->group, bodies_[b]->is_cuttable,
                          bodies_[b]->is_present};
    return placings;
}

std::uint64_t HapticLoop::next_sequence() const noexcept {
    std::uint64_t next = 0;
    for (const auto& body : bodies_) next = std::max(next, body->tracker.next_sequence());
    return next;
}

bool HapticLoop::take(Offer& offer) noexcept {
    KERF_ASSERT(offer.is_any(), "there is something to take over");
    return offer.is_turn() ? take_turn(offer) : take_change(offer);
}

/// Undo and redo: all bodies as they were at another time.
bool HapticLoop::take_turn(Offer& offer) noexcept {
    if (!is_clear_of_bone()) return false;
    close_open_stretches();
    if (offer.removing != removing_) return false;
    const std::uint64_t next = next_sequence();  // what was taken back stays in the log: records are numbered on
    for (std::size_t id = 0; id < offer.placings.count; ++id) {
        place_anew(*offer.made[id].body, offer.placings.of[id]);
        offer.made[id].body->tracker.number_from(next);
    }
    exchange_bodies(offer);
    if (offer.placings.knows_threads) threads_ = offer.placings.threads;
    held_.let_go();
    look_around();
    return true;
}

/// All others: bodies that go on, and some that come.
bool HapticLoop::take_change(Offer& offer) noexcept {
    if (!stamp_lacking(offer)) return false;
    go_on(offer);
    if (offer.change == Offer::Change::insertion || offer.change == Offer::Change::fusion) {
        const std::size_t last = offer.placings.count - 1;
        KERF_ASSERT(last == bodies_.size(), "the loop knows every body that is older");
        place_anew(*offer.made[last].body, offer.placings.of[last]);
    }
    const bool is_held_changed = std::any_of(bodies_.begin(), bodies_.end(), [&](const auto& body) {
        return offer.made[body->id].body != nullptr && held_.holds(body->id);
    });
    exchange_bodies(offer);
    if (is_held_changed) held_.forget_points();
    if (offer.change == Offer::Change::fusion) {
        for (const auto& body : bodies_) body->group = offer.placings.of[body->id].group;
        held_.take(bodies_, held_.body(), world_from_tool_);
    }
    if (offer.change == Offer::Change::subtraction) add_subtracted(offer);
    look_around();
    return true;
}

/// The last few records, which the trackers still know, are stamped here. False, and nothing is stamped: too many.
bool HapticLoop::stamp_lacking(const Offer& offer) noexcept {
    const auto for_each = [&](const auto& use) {
        for (const Offer::Made& made : offer.made)
            if (made.body != nullptr && made.follows)
                if (!use(made, Lacking(bodies_[*made.follows]->tracker, made.through))) return false;
        return true;
    };
    if (!for_each([](const Offer::Made&, const Lacking& lacking) { return !lacking.is_too_much; })) return false;
    return for_each([&](const Offer::Made& made, const Lacking& lacking) {
        for (std::size_t i = 0; i < lacking.count; ++i)
            made.body->committed.stamp(*lacking.record[i], solid(lacking.record[i]->solid));
        return true;
    });
}

/// Bodies that follow another one take over its pose and its open stretch.
void HapticLoop::go_on(const Offer& offer) noexcept {
    for (const Offer::Made& made : offer.made) {
        if (made.body == nullptr || !made.follows) continue;
        const LiveBody& before = *bodies_[*made.follows];
        made.body->world_from_body = before.world_from_body;
        made.body->is_present = before.is_present;
        const bool is_same = made.body->id == before.id;
        if (is_same)
            made.body->group = before.group;
        else
            threads_.pass_on(before.id, made.body->id);
        made.body->tracker.go_on_from(before.tracker, is_same ? before.tracker.next_sequence() : 0);
    }
}

void HapticLoop::place_anew(LiveBody& body, const Placing& placing) noexcept {
    body.world_from_body = placing.world_from_body;
    body.group = placing.group;
    body.is_cuttable = placing.is_cuttable;
    body.is_present = placing.is_present;
    body.tracker.take_tool(outline().cutting, static_cast<std::uint16_t>(tool_));
    body.tracker.restart(body.body_from(world_from_tool_));
}

/// What is replaced, and what there is no longer, goes into the offer.
void HapticLoop::exchange_bodies(Offer& offer) noexcept {
    while (bodies_.size() < offer.placings.count) bodies_.push_back(nullptr);
    const bool has_fewer = offer.is_turn() && offer.placings.count < bodies_.size();
    for (std::size_t id = 0; id < bodies_.size(); ++id)
        if (offer.made[id].body != nullptr || (has_fewer && id >= offer.placings.count))
            std::swap(bodies_[id], offer.made[id].body);
    if (has_fewer) bodies_.resize(offer.placings.count);
}

void HapticLoop::add_subtracted(Offer& offer) noexcept {
    for (CutRecord& record : offer.subtracted) {
        CutTracker& tracker = bodies_[record.body]->tracker;
        record.sequence = tracker.next_sequence();
        record.tick = tick_;
        tracker.number_from(record.sequence + 1);
        closed_.push_back(record);
    }
    removing_ += offer.subtracted.size();
}

void HapticLoop::look_around() noexcept { view_.place(bodies_, outline().whole, world_from_tool_, held_); }

void HapticLoop::place_body(std::size_t body, const Pose& world_from_body) noexcept {
    LiveBody& moved = *bodies_[body];
    moved.world_from_body = world_from_body;
    if (held_.holds(body)) held_.take(bodies_, held_.body(), world_from_tool_);
    moved.tracker.restart(moved.body_from(world_from_tool_));
    look_around();
}

void HapticLoop::show_body(std::size_t body, bool is_present) noexcept {
    bodies_[body]->is_present = is_present;
    if (held_.holds(body) && !is_present) held_.let_go();
    look_around();
}

void HapticLoop::remove_held() noexcept {
    for (const auto& body : bodies_) body->is_present = body->is_present && !held_.holds(body->id);
    held_.let_go();
    look_around();
}

}  // namespace kerf
