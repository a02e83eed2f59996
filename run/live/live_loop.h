// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "core/haptics/loop/haptic_loop.h"
#include "run/clock/tick_trace.h"
#include "run/live/live_hand.h"
#include "run/live/loop_link.h"
#include "run/next_actions.h"
#include "run/scene.h"

namespace kerf::run {

/// A haptic loop on the clock, with its hand. The run that records it takes the messages of the link, on another thread
/// or in `with_run`, and posts its changes there.
class LiveLoop final : LoopInputs {
public:
    /// Pre: `loop` is a second loop of the run's simulation; all others outlive this object.   [main]
    /// @param with_run  called where the run may catch up on the same thread; empty: it has a thread of its own
    LiveLoop(std::unique_ptr<HapticLoop> loop, const Scene& scene, const HandPlan& plan,
             const documents::Rehearsal& rehearsal, LoopLink& link, LiveHand& hand,
             std::function<void()> with_run = {});

    /// Lets another hand continue.   [main] between ticks
    void take_hand(LiveHand& hand) noexcept {
        hand_ = &hand;
        hand_->follow_step(step_);
    }
    /// From now on, the run has a thread of its own.   [main] between ticks
    void leave_run() { with_run_ = {}; }
    /// Measures the parts of each tick. Pre: `parts` outlives this object.
    void measure(TickParts& parts) noexcept { parts_ = &parts; }
    /// Times at which the force began to fade.
    struct Fades {
        std::uint64_t by_machine = 0, by_device = 0, by_fault = 0;
    };
    [[nodiscard]] const Fades& fades() const noexcept { return fades_; }

    /// Runs one tick after this number of missed periods, unless the hand pauses. Returns whether the loop continues.
    /// [haptic] without `with_run` it neither allocates nor blocks
    bool step(std::uint32_t missed);

private:
    void leg(std::size_t leg) noexcept override;
    void next_action() noexcept override;
    void undo() noexcept override { send({.kind = LoopMessage::Kind::undo}); }
    void run_drives(bool is_running) noexcept override;
    void loosen(bool is_loose) noexcept override;
    void repeat(std::size_t index, const documents::HandInput& input) noexcept override;

    [[nodiscard]] bool is_over() const noexcept {
        return link_->is_overrun || link_->should_stop.load(std::memory_order_acquire);
    }
    [[nodiscard]] bool pause() noexcept;
    void carry_out_immediate(const std::vector<documents::HandInput>& inputs) noexcept;
    bool take_change();
    void take_changes() {
        while (take_change()) catch_up();
    }
    [[nodiscard]] bool take_separation() noexcept;
    void count_fades(const DeviceSample& sample) noexcept;
    void send(const LoopMessage& message) noexcept;
    /// Returns whether the run has not yet answered what was sent up to the last milestone of the hand.
    [[nodiscard]] bool awaits_run() const noexcept {
        return sent_ - link_->messages.size() < awaited_ || link_->change.is_out() || link_->is_busy;
    }
    void end_of(TickPart part) noexcept {
        if (parts_ != nullptr) parts_->end_of(part);
    }
    void catch_up() {
        if (with_run_) with_run_();
    }

    std::unique_ptr<HapticLoop> loop_;
    const HandPlan* plan_;
    bool is_direct_;
    LoopLink* link_;
    LiveHand* hand_;
    std::function<void()> with_run_;
    TickParts* parts_ = nullptr;
    NextActions next_actions_;
    std::uint64_t adopted_ = 0, taken_ = 0;  ///< numbers of separations and changes taken over
    int delays_ = 0;                         ///< ticks for which the posted change could not be taken over
    std::size_t step_ = 0;                   ///< of the procedure, as the run last reported
    TickResult last_;
    std::size_t milestone_ = 0;
    std::uint64_t sent_ = 0;     ///< number of messages
    std::uint64_t awaited_ = 0;  ///< number of messages that the run must have taken before the hand continues
    bool was_paused_ = false;
    bool was_fading_ = false;
    Fades fades_;
};

}  // namespace kerf::run
