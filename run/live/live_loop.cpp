// SPDX-License-Identifier: Apache-2.0
#include "run/live/live_loop.h"

#include <utility>
#include <vector>

#include "run/hand_inputs.h"
#include "run/recorded_pose.h"

namespace kerf::run {

LiveLoop::LiveLoop(std::unique_ptr<HapticLoop> loop, const Scene& scene, const HandPlan& plan,
                   const documents::Rehearsal& rehearsal, LoopLink& link, LiveHand& hand,
                   std::function<void()> with_run)
    : loop_(std::move(loop)),
      plan_(&plan),
      is_direct_(scene.procedure.is_direct),
      link_(&link),
      hand_(&hand),
      with_run_(std::move(with_run)),
      next_actions_(rehearsal) {}

/// Lets a period pass without a tick. Returns whether the loop continues.
bool LiveLoop::pause() noexcept {
    was_paused_ = true;
    if (is_over()) hand_->rest();
    return !is_over();
}

bool LiveLoop::step(std::uint32_t missed) {
    if (hand_->is_paused()) return pause();
    if (std::exchange(was_paused_, false)) {
        missed = 0;
        send({.kind = LoopMessage::Kind::pause});
    }
    take_changes();
    end_of(TickPart::change);
    hand_->act(missed, last_, *this);
    if (with_run_) {  // with a thread of its own, the run has not yet answered
        with_run_();
        take_changes();
    }
    end_of(TickPart::inputs);

    DeviceSample sample = hand_->sample(*loop_);
    sample.world_from_handle = without_negative_zeros(sample.world_from_handle);
    sample.missed = missed;
    end_of(TickPart::hand);
    last_ = is_direct_ ? loop_->tick_direct(sample) : loop_->tick(sample);
    count_fades(sample);
    end_of(TickPart::motion);
    hand_->wait(awaits_run());
    hand_->feel(last_, *loop_);
    end_of(TickPart::hand);
    loop_->reserve_bricks(bricks_of_a_tick);
    const bool has_adopted = take_separation();
    end_of(TickPart::change);
    send({.kind = LoopMessage::Kind::tick, .has_adopted = has_adopted, .sample = sample, .bits = bits_of(last_)});
    if (std::exchange(milestone_, hand_->milestone()) != hand_->milestone()) awaited_ = sent_;
    catch_up();

    auto end = hand_->end();
    if (end == RunEnd::path_ended && awaits_run()) end.reset();  // what the hand requested last
    if (end) send({.kind = LoopMessage::Kind::ended, .index = static_cast<std::size_t>(*end)});
    const bool has_more = !end && !is_over();
    if (!has_more) hand_->rest();
    if (end) catch_up();
    return has_more;
}

/// Takes over the change that the run has posted, if the loop can now. Returns false if there is none.
bool LiveLoop::take_change() {
    PostedChange* posted = link_->change.posted();
    if (posted == nullptr) return false;
    if (loop_->ticks() < posted->due) return false;
    LoopChange& change = posted->change;
    LoopMessage answer{.kind = posted->is_refused ? LoopMessage::Kind::refused : LoopMessage::Kind::changed};
    if (change.offer.is_any() && !posted->is_refused) {
        constexpr int patience = 20;  // ticks
        const Takeover takeover = loop_->can_take(change.offer);
        if (takeover == Takeover::not_yet && ++delays_ < patience) return false;
        delays_ = 0;
        if (takeover != Takeover::possible)
            answer.kind = change.offer.is_history_change() ? LoopMessage::Kind::refused : LoopMessage::Kind::outdated;
    }
    if (answer.kind == LoopMessage::Kind::changed) {
        // If it is outdated, the loop commits the records by itself. The offer stays whole, for the run to destroy.
        if (change.committed.is_any() &&
            (posted->adopted != adopted_ || loop_->can_take(change.committed) != Takeover::possible))
            change.committed.change = Offer::Change::none;
        loop_->take(change);
        ++taken_;
        if (change.tool) hand_->take_tool();
    }
    if (answer.kind != LoopMessage::Kind::outdated && std::exchange(step_, posted->step) != posted->step)
        hand_->follow_step(step_);
    link_->change.give_back();
    send(answer);
    awaited_ = sent_;
    return true;
}

bool LiveLoop::take_separation() noexcept {
    PostedSeparation* posted = link_->separation.posted();
    if (posted == nullptr || loop_->ticks() < link_->separation_due) return false;
    const bool is_possible = posted->changes == taken_ && loop_->can_take(posted->offer) == Takeover::possible;
    if (is_possible) {
        static_cast<void>(loop_->take(posted->offer));
        ++adopted_;
    }
    link_->separation.give_back();
    if (!is_possible) send({.kind = LoopMessage::Kind::separation});
    return is_possible;
}

void LiveLoop::count_fades(const DeviceSample& sample) noexcept {
    if (std::exchange(was_fading_, last_.is_closed_or_closing) || !last_.is_closed_or_closing) return;
    ++(sample.missed >= HandMotion::missed_ticks_of_pause ? fades_.by_machine
       : sample.is_lost                                   ? fades_.by_device
                                                          : fades_.by_fault);
}

void LiveLoop::carry_out_immediate(const std::vector<documents::HandInput>& inputs) noexcept {
    for (const documents::HandInput& input : inputs)
        if (is_immediate(input.kind)) static_cast<void>(carry_out_at(*loop_, input));
}

void LiveLoop::leg(std::size_t leg) noexcept {
    carry_out_immediate(plan_->inputs[leg]);
    send({.kind = LoopMessage::Kind::leg, .index = leg});
    awaited_ = sent_;
}

void LiveLoop::next_action() noexcept {
    const auto action = next_actions_.take(step_);
    if (!action) return;
    carry_out_immediate(next_actions_.inputs(*action));
    send({.kind = LoopMessage::Kind::action, .index = *action});
}

void LiveLoop::run_drives(bool is_running) noexcept {
    const ToolSetup& setup = loop_->setup();
    for (std::size_t i = 0; i < setup.drives.size(); ++i) {
        if (setup.drives[i] == 0.0) continue;
        const double value = is_running ? setup.drives[i] : 0.0;
        loop_->command_drive(i, value);
        send({.kind = LoopMessage::Kind::drive, .index = i, .value = value});
    }
}

void LiveLoop::loosen(bool is_loose) noexcept {
    if (is_loose && !loop_->outline().has_thread()) return;
    loop_->loosen_about_shaft(is_loose);
    send({.kind = LoopMessage::Kind::regrip, .value = is_loose ? 1.0 : 0.0});
}

void LiveLoop::repeat(std::size_t index, const documents::HandInput& input) noexcept {
    if (is_immediate(input.kind)) static_cast<void>(carry_out_at(*loop_, input));
    next_actions_.follow(step_, input);
    send({.kind = LoopMessage::Kind::repeated, .index = index});
}

void LiveLoop::send(const LoopMessage& message) noexcept {
    if (link_->is_overrun) return;  // nothing after a gap
    if (!link_->messages.push(message)) link_->is_overrun = true;
    ++sent_;
}

}  // namespace kerf::run
