// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/scene/simulation.h"

#include <utility>

#include "kerf/assert.hpp"

namespace kerf {

Simulation::Simulation(const Body& body, ToolSetup setup, ToolOutline outline, const CouplingGains& gains,
                       const Pose& start, double period)
    : Simulation(body, std::vector<Tool>{{std::move(setup), std::move(outline)}}, gains, start, period) {}

Simulation::Simulation(const Body& body, std::vector<Tool> tools, const CouplingGains& gains, const Pose& start,
                       double period)
    : HapticLoop(body, std::move(tools), gains, start, period), scene_(body, cutting_solids()) {}

TickResult Simulation::tick(const DeviceSample& sample) {
    const TickResult result = HapticLoop::tick(sample);
    follow_tick(result);
    return result;
}

TickResult Simulation::tick_direct(const DeviceSample& sample) {
    const TickResult result = HapticLoop::tick_direct(sample);
    follow_tick(result);
    return result;
}

void Simulation::follow_tick(const TickResult& result) {
    follow();
    if (result.is_stripping) strip();
    if (is_deferring_) prepare_late_changes();
}

void Simulation::follow() { follow_from(0); }

/// Does what `follow` does, with the records of `closed` from index `first` on.
void Simulation::follow_from(std::size_t first) {
    std::vector<CutRecord> removing;
    for (const CutRecord& record : closed().subspan(first))
        if (record.removes) removing.push_back(record);
    if (prepared_.offer.added != nullptr) {
        held_back_.insert(held_back_.end(), removing.begin(), removing.end());
    } else if (!removing.empty()) {
        scene_.apply(removing, body_states());
    } else if (is_clear_of_bone()) {
        scene_.end_cut();
        scene_.set_threads(threads());
    }
    present().reserve(bricks_of_a_tick);
    if (is_deferring_)
        reserve_bricks(bricks_of_a_tick);
    else
        make_room();
    take_separations_due(false);
}

void Simulation::close_and_follow() {
    close_stretches();
    follow();
}

void Simulation::take_tool(std::size_t tool) {
    if (tool != this->tool()) take_another(tool);
}

void Simulation::take_another(std::size_t tool, double back) {
    close_and_follow();
    HapticLoop::take_tool(tool, back);
}

void Simulation::finish() {
    is_deferring_ = false;  // no second loop is left
    drop_change();
    close_and_follow();
    flush();
    take_separations_due(true);  // the last cut is done
}

// ---- changes of bodies --------------------------------------------------------------------------------------------

void Simulation::take_over(Offer offer) {
    const BodyStates before = body_states();
    const bool is_taken = take(offer);
    KERF_ASSERT(is_taken, "in lock-step an offer lacks nothing");
    static_cast<void>(is_taken);
    scene_.taken(offer, before, next_sequence());
    if (offer.separation) separations_.push_back(std::move(*offer.separation));
}

void Simulation::take_separations_due(bool all) {
    const auto is_due = [&] {
        if (all) return true;
        if (!adoption_ticks_) return scene_.waiting()->tick + adoption_delay <= ticks();
        return !adoption_ticks_->empty() && adoption_ticks_->front() <= ticks();
    };
    while (scene_.waiting() != nullptr && is_due()) {
        if (adoption_ticks_ && !adoption_ticks_->empty()) adoption_ticks_->erase(adoption_ticks_->begin());
        take_over(scene_.separation());
    }
}

std::string Simulation::insert(const Body& body, const Pose& world_from_body, bool is_cuttable,
                               std::optional<std::size_t> rigid_to) {
    if (!is_deferring_) take_separations_due(true);  // ids are given in order
    std::string why_not;
    Offer offer = scene_.insertion(body, world_from_body, is_cuttable, body_states(), why_not);
    if (rigid_to && offer.is_any())
        offer.body_states.of[offer.body_states.count - 1].group =
            static_cast<std::uint16_t>(bodies()[*rigid_to]->group);
    if (offer.is_any()) change(std::move(offer));
    return why_not;
}

void Simulation::begin_with(const Body& body, const Pose& world_from_body) {
    static_cast<void>(insert(body, world_from_body, true));  // the second body, of the same tissues
    scene_.forget_changes();
}

std::string Simulation::fuse() {
    if (held() < 0) return "nothing is held";
    if (!is_deferring_) take_separations_due(true);
    std::string why_not;
    Offer offer = scene_.fusion(static_cast<std::size_t>(held()), body_states(), why_not);
    if (offer.is_any()) change(std::move(offer));
    return why_not;
}

void Simulation::subtract(std::size_t solid, const Pose& world_from_tool) {
    if (is_deferring_) return prepare({static_cast<std::uint16_t>(solid), world_from_tool});
    close_and_follow();
    take_separations_due(true);
    take_over(scene_.subtraction(static_cast<std::uint16_t>(solid), world_from_tool, body_states()));
}

/// Subtracts the cylinder around the tool's thread after the tick that stripped the bone. `closed` then also contains
/// the records of that tick.
void Simulation::strip() {
    if (is_deferring_) {
        stripped_at_ = {static_cast<std::uint16_t>(crest_number()), world_from_tool()};
        return;
    }
    const std::size_t first = closed().size();
    close_more_stretches();
    follow_from(first);
    take_separations_due(true);
    take_over(scene_.subtraction(static_cast<std::uint16_t>(crest_number()), world_from_tool(), body_states()));
}

std::string Simulation::turn_back(HistoryChange turn) {
    if (!is_clear_of_bone()) return "the tool is not clear of the bone";
    if (!is_deferring_) close_and_follow();
    scene_.end_cut();
    if (!scene_.can(turn))
        return turn == HistoryChange::undo ? "there is no cut to take back" : "there is no cut to do again";
    change(scene_.turn(turn));
    return {};
}

// ---- a second loop ------------------------------------------------------------------------------------------------

std::unique_ptr<HapticLoop> Simulation::second_loop(std::vector<Tool> tools, const CouplingGains& gains,
                                                    const Pose& start, std::size_t free_bricks) const {
    auto loop = std::make_unique<HapticLoop>(*bodies().front()->bone, std::move(tools), gains, start);
    BoneScene scene(*bodies().front()->bone, loop->cutting_solids());
    for (const auto& body : bodies().subspan(1)) {
        std::string why_not;
        Offer offer =
            scene.insertion(*body->bone, body->world_from_body, body->is_cuttable, loop->body_states(), why_not);
        const BodyStates before = loop->body_states();
        static_cast<void>(loop->take(offer));
        scene.taken(offer, before, loop->next_sequence());
    }
    loop->reserve_bricks(free_bricks);
    return loop;
}

void Simulation::defer_changes() {
    is_deferring_ = true;
    if (!adoption_ticks_) adoption_ticks_.emplace();
}

/// Makes a change of bodies, or prepares it.
void Simulation::change(Offer offer) {
    if (!is_deferring_) return take_over(std::move(offer));
    prepared_.offer = std::move(offer);
}

void Simulation::prepare(const Subtraction& subtraction) {
    subtracting_ = subtraction;
    change(scene_.subtraction(subtraction.solid, subtraction.world_from_tool, body_states()));
}

/// Prepares what `tick` would do at once without a second loop.
void Simulation::prepare_late_changes() {
    if (stripped_at_ && !prepared_.is_any() && scene_.waiting() == nullptr)
        prepare(*std::exchange(stripped_at_, std::nullopt));
    if (lacks_held_points() && !prepared_.is_any()) prepared_.held_points = held_points();
}

LoopChange Simulation::prepared_for_second() const {
    LoopChange copy;
    if (prepared_.offer.is_any()) copy.offer = copy_of(prepared_.offer);
    copy.held_points = prepared_.held_points;
    return copy;
}

void Simulation::make_change() {
    LoopChange made = std::exchange(prepared_, {});
    subtracting_.reset();
    if (made.offer.needs_closed_stretches()) close_and_follow();
    if (made.offer.is_history_change()) scene_.end_cut();
    if (made.offer.is_any()) take_over(std::move(made.offer));
    if (made.held_points) set_held_points(*made.held_points);
    apply_held_back();
}

void Simulation::apply_held_back() {
    if (!held_back_.empty()) scene_.apply(std::exchange(held_back_, {}), body_states());
}

void Simulation::drop_change() {
    prepared_ = {};
    subtracting_.reset();
    apply_held_back();
}

void Simulation::renew_change() {
    if (subtracting_) prepare(Subtraction(*subtracting_));
}

Offer Simulation::committed_for_second() const {
    constexpr std::size_t few = 4;               // records, which a loop commits by itself
    if (scene_.waiting() != nullptr) return {};  // the scene's bodies are not those of the loop
    return scene_.committed([&](std::size_t body) { return bodies()[body]->tracker.pending_count() > few; });
}

}  // namespace kerf
