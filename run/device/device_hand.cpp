// SPDX-License-Identifier: Apache-2.0
#include "run/device/device_hand.h"

#include <algorithm>

#include "core/haptics/loop/tick_result.h"

namespace kerf::run {

namespace {
constexpr double max_age = 20e-3;  // [s] of a report; a slower device than 50 Hz cannot be used
}

DeviceHand::DeviceHand(const documents::DeviceStation& station, const kerf_device_facts& facts,
                       const Pose& world_from_tool)
    : station_(station),
      frame_(station, (facts.abilities & KERF_DEVICE_ROTATION) != 0),
      has_drive_button_(std::find(station.buttons.begin(), station.buttons.begin() + facts.button_count,
                                  documents::ButtonAction::drive) != station.buttons.begin() + facts.button_count),
      wanted_(world_from_tool) {
    presses_.is_driving = !has_drive_button_;
}

bool DeviceHand::is_pressed(documents::ButtonAction action, std::uint32_t buttons) const noexcept {
    for (std::size_t i = 0; i < documents::max_buttons; ++i)
        if ((buttons >> i & 1u) != 0 && station_.buttons[i] == action) return true;
    return false;
}

DeviceSample DeviceHand::take(const kerf_device_state& state) noexcept {
    using documents::ButtonAction;
    if ((state.flags & KERF_DEVICE_VALID) == 0 || !(state.age <= max_age)) {
        ++lost_ticks_;
        is_joined_ = false;
        presses_ = {.is_driving = !has_drive_button_};
        buttons_ = 0;
        return {.world_from_handle = wanted_, .is_lost = true};
    }
    lost_ticks_ = 0;
    const bool is_clutched = is_pressed(ButtonAction::clutch, state.buttons);
    if (!is_joined_) frame_.join(state.device_from_handle, wanted_);
    is_joined_ = !is_clutched;
    if (!is_clutched) wanted_ = frame_.tool_for(state.device_from_handle);
    const auto is_new = [&](ButtonAction action) {
        return is_pressed(action, state.buttons) && !is_pressed(action, buttons_);
    };
    presses_ = {.is_driving = !has_drive_button_ || is_pressed(ButtonAction::drive, state.buttons),
                .wants_next = is_new(ButtonAction::next),
                .wants_undo = is_new(ButtonAction::undo)};
    buttons_ = state.buttons;
    return {.world_from_handle = wanted_};
}

kerf_device_command DeviceHand::command(const TickResult& result, std::uint64_t tick) const noexcept {
    const bool has_force = !result.is_closed_or_closing && !result.is_coming_back;
    return {.tick = tick,
            .force = frame_.to_device(linear(result.command.wrench)),
            .torque = frame_.to_device(angular(result.command.wrench)),
            .device_from_tool = frame_.to_device(result.world_from_tool),
            .flags = KERF_DEVICE_RUNNING | (has_force ? std::uint32_t{KERF_DEVICE_FORCE_ON} : 0u),
            .reserved = 0};
}

}  // namespace kerf::run
