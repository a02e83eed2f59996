// SPDX-License-Identifier: Apache-2.0
#include "run/live/recorded_hand.h"

namespace kerf::run {

std::uint32_t RecordedHand::missed() noexcept {
    const auto& missed = beginning_->run.missed;
    return next_missed_ < missed.size() && missed[next_missed_].first == tick_ ? missed[next_missed_++].second : 0;
}

void RecordedHand::act(std::uint32_t /*missed*/, const TickResult& /*last*/, LoopInputs& inputs) noexcept {
    const RecordedInputs& recorded = beginning_->run.hand_inputs;
    for (; next_input_ < recorded.size() && recorded[next_input_].first <= tick_; ++next_input_)
        inputs.repeat(next_input_, recorded[next_input_].second);
}

DeviceSample RecordedHand::sample(const HapticLoop& /*loop*/) noexcept {
    const auto& lost = beginning_->run.lost;
    for (; next_lost_ < lost.size() && lost[next_lost_].first <= tick_; ++next_lost_)
        is_lost_ = lost[next_lost_].second;
    return {.world_from_handle = beginning_->run.replay[tick_++], .is_lost = is_lost_};
}

}  // namespace kerf::run
