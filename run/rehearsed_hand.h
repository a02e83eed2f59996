// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "devices/simulated_hand/simulated_hand.h"
#include "run/scene.h"

namespace kerf::run {

/// The simulated hand that carries out a rehearsal at a loop.
class RehearsedHand {
public:
    /// Inputs other than motion before a tick.
    struct Inputs {
        std::optional<bool> loosens;     ///< the hand releases the tool about its shaft, or grips it again
        std::optional<std::size_t> leg;  ///< index into `HandPlan::inputs`
    };

    /// Pre: `plan` outlives this object.
    explicit RehearsedHand(const HandPlan& plan);

    /// Returns the inputs before the next tick. The first is `loosens`, because the hand regrips before it releases an
    /// implant.   [haptic, nonblocking]
    [[nodiscard]] Inputs take_inputs() noexcept;
    /// Lets the hand move during missed periods, under the command of the last tick. To be called before `take_inputs`.
    void move_on(std::uint32_t missed, const TickResult& last);
    [[nodiscard]] Pose reported() const noexcept { return hand_.reported(); }
    /// Lets the hand move for one tick under its result.   [haptic, nonblocking]
    void feel(const TickResult& result, const HapticLoop& loop);
    /// Lets the hand take another tool, which the loop moves to the handle: a slip of the last one no longer counts.
    /// [haptic, nonblocking]
    void take_tool() noexcept;
    /// Lets the hand keep its aim, or continue (false).   [haptic, nonblocking]
    void wait(bool waits) noexcept { is_waiting_ = waits; }
    /// Returns whether the path has ended, with all inputs taken.
    [[nodiscard]] bool is_done() const noexcept { return hand_.is_done() && !is_due(hand_.leg()); }
    [[nodiscard]] std::size_t leg() const noexcept { return hand_.leg(); }

private:
    [[nodiscard]] bool is_due(std::size_t leg) const noexcept {
        return next_ <= leg && leg < plan_->inputs.size() && !plan_->inputs[leg].empty();
    }
    [[nodiscard]] simulated_hand::SensedTool sensed(const TickResult& result) const;
    void note_force(const TickResult& result, const HapticLoop& loop);

    const HandPlan* plan_;
    simulated_hand::SimulatedHand hand_;
    std::size_t next_ = 0;  ///< first leg whose inputs were not taken
    bool is_regripping_ = false, is_waiting_ = false;
    double force_before_ = 0.0;   ///< [N] of the device on the hand, before it was lost
    bool is_force_away_ = false;  ///< after a fault, until it is fully back
    bool has_slipped_ = false;    ///< the tool was anchored anew in the hand
};

}  // namespace kerf::run
