// SPDX-License-Identifier: Apache-2.0
#include "run/rehearsed_hand.h"

#include <algorithm>
#include <utility>

namespace kerf::run {

namespace {
constexpr std::uint32_t max_moved_periods = 1000;  // of a pause; in a longer one the hand waits
constexpr double noticed_force = 0.1;              // [N] on the hand: a hand notices when it fades [assumed]
}  // namespace

RehearsedHand::RehearsedHand(const HandPlan& plan)
    : plan_(&plan), hand_(plan.plant, plan.intent, plan.start, HapticLoop::dt) {}

RehearsedHand::Inputs RehearsedHand::take_inputs() noexcept {
    Inputs inputs;
    const std::size_t leg = hand_.leg();
    if (hand_.is_regripping() != std::exchange(is_regripping_, hand_.is_regripping())) inputs.loosens = is_regripping_;
    if (leg == next_ && is_due(leg)) inputs.leg = leg;
    next_ = std::max(next_, leg + 1);  // waypoints that a hand skipped have no inputs
    return inputs;
}

void RehearsedHand::move_on(std::uint32_t missed, const TickResult& last) {
    simulated_hand::SensedTool tool = sensed(last);
    tool.has_event = false;  // the hand felt the event when the last tick ended
    for (std::uint32_t i = 0; i < std::min(missed, max_moved_periods); ++i) hand_.step(last.command, tool);
}

void RehearsedHand::take_tool() noexcept {
    if (std::exchange(has_slipped_, false)) hand_.regrasp(identity_pose());
}

void RehearsedHand::feel(const TickResult& result, const HapticLoop& loop) {
    note_force(result, loop);
    hand_.step(result.command, sensed(result));
}

/// Follows the force of the device before, in and after a fault, and gives the hand the tool as it then lies in it.
void RehearsedHand::note_force(const TickResult& result, const HapticLoop& loop) {
    has_slipped_ |= result.has_event(TickResult::anchored_again);
    const bool was_away = std::exchange(is_force_away_, result.is_closed_or_closing || result.is_coming_back);
    if (is_force_away_) return;
    force_before_ = length(linear(result.command.wrench));
    if (was_away || (has_slipped_ && loop.is_realigning())) hand_.regrasp(inverse(loop.grasp()));
}

simulated_hand::SensedTool RehearsedHand::sensed(const TickResult& result) const {
    const std::string& awaited = hand_.awaited_event();
    return {.world_from_tool = result.world_from_tool,
            .torque = result.torque,
            .keeps_aim = is_waiting_ || (is_force_away_ && force_before_ > noticed_force),
            .has_event = !awaited.empty() && result.has_event(awaited)};
}

}  // namespace kerf::run
