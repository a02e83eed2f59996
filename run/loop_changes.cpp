// SPDX-License-Identifier: Apache-2.0
#include "run/loop_changes.h"

#include <algorithm>
#include <utility>

#include "run/live/loop_link.h"

namespace kerf::run {

void LoopChanges::begin_replay(std::vector<LateChange> late) {
    if (late.empty()) return;
    late_ = std::move(late);
    mode_ = Mode::replay;
    simulation_->defer_changes();
}

void LoopChanges::begin_following(LoopLink& link) {
    link_ = &link;
    mode_ = Mode::following;
    simulation_->defer_changes();
}

void LoopChanges::repeat(std::vector<LateChange> late, std::vector<std::uint64_t> adoptions, std::uint64_t ticks) {
    late_ = std::move(late);
    adoptions_ = std::move(adoptions);
    std::erase_if(late_, [&](const LateChange& one) { return one.tick > ticks; });
    std::erase_if(adoptions_, [&](std::uint64_t tick) { return tick > ticks; });
}

/// Returns how the recorded run made the posted change; null: at once.
const LateChange* LoopChanges::late() const noexcept {
    const auto found =
        std::find_if(late_.begin(), late_.end(), [&](const LateChange& one) { return one.number == number_; });
    return found == late_.end() ? nullptr : &*found;
}

// ---- decisions ----------------------------------------------------------------------------------------------------

void LoopChanges::lead(const std::optional<Guide>& guide) {
    const bool is_same = guide_ && *guide_ == guide;
    guide_ = guide;
    if (is_in_lock_step())
        simulation_->lead(guide);
    else if (!is_same)
        next_.guide = guide;
}

void LoopChanges::take_tool(std::size_t tool, double back) {
    if (is_in_lock_step()) return simulation_->take_another(tool, back);
    next_.tool = tool;
    next_.back = back;
}

void LoopChanges::remove_held() {
    if (is_in_lock_step())
        simulation_->remove_held();
    else
        next_.removes_held = true;
}

// ---- changes ------------------------------------------------------------------------------------------------------

void LoopChanges::post(std::size_t step) {
    if (is_in_lock_step() || posted_ || !(next_.is_any() || simulation_->prepared() != nullptr || step != step_))
        return;
    posted_ = std::exchange(next_, {});
    const LoopChange* prepared = simulation_->prepared();
    if (posted_->tool && prepared != nullptr && prepared->offer.needs_closed_stretches()) {
        // Each of the two closes stretches, whose records are passed on in between.
        next_.tool = std::exchange(posted_->tool, std::nullopt);
        next_.back = posted_->back;
    }
    posted_->changes_bodies = prepared != nullptr;
    posted_at_ = simulation_->ticks();
    step_ = step;
    ++number_;
    if (link_ != nullptr) post_to_loop();
}

void LoopChanges::post_to_loop() {
    PostedChange change{posted_->changes_bodies ? simulation_->prepared_for_second() : LoopChange{}, step_, adopted_};
    change.change.guide = posted_->guide;
    change.change.removes_held = posted_->removes_held;
    change.change.tool = posted_->tool;
    change.change.back = posted_->back;
    if (posted_->tool) change.change.committed = simulation_->committed_for_second();
    if (const LateChange* late = this->late(); late != nullptr) {
        change.due = late->tick;
        change.is_refused = late->is_refused;
    }
    link_->change.post(std::move(change));
}

std::optional<LoopChanges::Due> LoopChanges::due() const {
    if (mode_ != Mode::replay || !posted_) return std::nullopt;
    const LateChange* late = this->late();
    if (late == nullptr) return Due{};
    if (simulation_->ticks() < late->tick) return std::nullopt;
    return Due{late->is_refused};
}

LoopChanges::Made LoopChanges::make(bool is_refused) {
    const auto can_take = [this](const LoopChange* change) {
        return change == nullptr || !change->offer.is_any() ? Takeover::possible : simulation_->can_take(change->offer);
    };
    if (posted_->changes_bodies && !is_refused && can_take(simulation_->prepared()) == Takeover::outdated)
        simulation_->renew_change();
    const LoopChange* prepared = posted_->changes_bodies ? simulation_->prepared() : nullptr;
    is_refused = is_refused || can_take(prepared) != Takeover::possible;  // as in a session that was changed
    Made made;
    made.number = number_;
    made.is_late = is_refused || is_late();
    made.is_refused = is_refused;
    if (link_ != nullptr) link_->change.empty();
    if (is_refused) {
        if (posted_->changes_bodies) simulation_->drop_change();
        // The loop took over no part of it.
        if (!next_.guide) next_.guide = posted_->guide;
        if (!next_.tool) {
            next_.tool = posted_->tool;
            next_.back = posted_->back;
        }
        next_.removes_held |= posted_->removes_held;
    } else {
        if (posted_->guide) simulation_->lead(*posted_->guide);
        if (prepared != nullptr) {
            made.has_closed_stretches = prepared->offer.needs_closed_stretches();
            simulation_->make_change();
        }
        if (posted_->removes_held) simulation_->remove_held();
        if (posted_->tool) {
            made.has_closed_stretches = true;
            made.tool = posted_->tool;
            simulation_->take_another(*posted_->tool, posted_->back);
        }
    }
    posted_.reset();
    if (!is_refused) ++made_;
    return made;
}

void LoopChanges::renew() {
    link_->change.empty();
    simulation_->renew_change();
    post_to_loop();
}

void LoopChanges::show_busy(bool is_waiting) noexcept {
    if (link_ != nullptr) link_->is_busy = is_waiting || awaits_tool();
}

void LoopChanges::drop_tool() noexcept {
    next_.tool.reset();
    if (posted_) posted_->tool.reset();
}

// ---- separations --------------------------------------------------------------------------------------------------

/// Returns the number of ticks after which the loop may take over a separation.
std::uint64_t LoopChanges::separation_due(const Separation& waiting, bool now) const noexcept {
    if (adopted_ < adoptions_.size()) return adoptions_[adopted_];
    return now ? 0 : waiting.tick + Simulation::adoption_delay;
}

void LoopChanges::post_separation(bool now) {
    const Separation* waiting = simulation_->waiting_separation();
    if (link_ == nullptr || waiting == nullptr) return;
    const std::uint64_t due = separation_due(*waiting, now);
    if (is_separation_posted_) {
        if (now) link_->separation_due = due;
        return;
    }
    link_->separation_due = due;
    link_->separation.post({simulation_->separation_for_second(), made_});
    is_separation_posted_ = true;
}

void LoopChanges::adopt() {
    simulation_->adopt_after(simulation_->ticks() + 1);
    ++adopted_;
    renew_separation();
}

void LoopChanges::renew_separation() {
    link_->separation.empty();
    is_separation_posted_ = false;
}

}  // namespace kerf::run
