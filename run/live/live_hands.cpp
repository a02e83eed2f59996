// SPDX-License-Identifier: Apache-2.0
#include "run/live/live_hands.h"

#include <utility>

#include "kerf/device_exchange.hpp"

namespace kerf::run {

void LiveRehearsal::act(std::uint32_t missed, const TickResult& last, LoopInputs& inputs) noexcept {
    if (missed > 0) hand_.move_on(missed, last);
    const RehearsedHand::Inputs due = hand_.take_inputs();
    if (due.loosens) inputs.loosen(*due.loosens);
    if (due.leg) inputs.leg(*due.leg);
}

void LiveDevice::act(std::uint32_t /*missed*/, const TickResult& /*last*/, LoopInputs& inputs) noexcept {
    const ButtonPresses& presses = hand_.presses();
    if (std::exchange(is_driving_, presses.is_driving) != presses.is_driving) inputs.run_drives(presses.is_driving);
    if (presses.wants_undo) inputs.undo();
    if (presses.wants_next) inputs.next_action();
}

void LiveDevice::rest() noexcept { device_->write(command_at_rest()); }

}  // namespace kerf::run
