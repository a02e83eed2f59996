// SPDX-License-Identifier: Apache-2.0
#include "run/device/device_hand.h"

#include <cmath>
#include <numbers>

#include "core/haptics/loop/device_report.h"
#include "core/haptics/loop/tick_result.h"
#include "core/haptics/scene/simulation.h"
#include "kerf/device_buttons.hpp"
#include "kerf/exact_math.hpp"

namespace kerf::run {

namespace {

constexpr double max_age = 20e-3;  // [s] of a report

}  // namespace

DeviceHand::DeviceHand(const documents::DeviceStation& station, const kerf_device_facts& facts,
                       const Pose& world_from_tool, const Arm& arm)
    : station_(station),
      frame_(station, (facts.abilities & KERF_DEVICE_ROTATION) != 0),
      pressable_(button_bits(facts.button_count)),
      has_drive_button_(is_pressed(documents::ButtonAction::drive, pressable_)),
      has_knob_motor_((facts.abilities & KERF_DEVICE_TURN_TORQUE) != 0),
      wanted_(world_from_tool) {
    if ((facts.abilities & KERF_DEVICE_DEFLECTION) != 0) aimed_.emplace(station, arm, world_from_tool, Simulation::dt);
    presses_.is_driving = !has_drive_button_;
}

bool DeviceHand::is_pressed(documents::ButtonAction action, std::uint32_t buttons) const noexcept {
    for (std::size_t i = 0; i < documents::max_buttons; ++i)
        if ((buttons >> i & 1u) != 0 && station_.buttons[i] == action) return true;
    return false;
}

/// Lets the force fade, and the motor stop if a button runs it.
DeviceSample DeviceHand::rest() noexcept {
    is_joined_ = false;
    if (aimed_) aimed_->stop();
    presses_ = {.is_driving = !has_drive_button_};
    return {.world_from_handle = wanted_, .is_lost = true};
}

bool DeviceHand::is_there(const kerf_device_state& state) const noexcept {
    if ((state.flags & KERF_DEVICE_VALID) == 0) return false;
    return aimed_ ? is_usable(state.deflection) : state.age <= max_age && is_usable(state.device_from_handle);
}

Pose DeviceHand::wanted_for(const kerf_device_state& state, Vec3 grip) noexcept {
    if (aimed_) {
        const double(&d)[6] = state.deflection;
        return turned(aimed_->step({d[0], d[1], d[2]}, {d[3], d[4], d[5]}, last_command_), state.turn);
    }
    if (!is_joined_ || length(grip - grip_) > 0.0) {
        frame_.join(state.device_from_handle, wanted_, grip);
        turn_at_join_ = state.turn;
    }
    grip_ = grip;
    return turned(frame_.tool_for(state.device_from_handle), state.turn - turn_at_join_);
}

Pose DeviceHand::turned(const Pose& tool, double turn) const noexcept {
    if (turn == 0.0) return tool;
    const SinCos half = sin_cos_exact(std::remainder(0.5 * turn, 2.0 * std::numbers::pi));
    return {tool.position, normalized(tool.rotation * Quat{half.cos, 0.0, 0.0, half.sin})};
}

DeviceSample DeviceHand::take(const kerf_device_state& state, Vec3 grip) noexcept {
    using documents::ButtonAction;
    const bool is_lost = !is_there(state);
    lost_ticks_ = is_lost ? lost_ticks_ + 1 : 0;
    if (is_lost) return rest();
    const std::uint32_t buttons = state.buttons & pressable_;
    const std::uint32_t before = buttons_.value_or(buttons);  // what is pressed at the start was not pressed now
    buttons_ = buttons;
    if (is_pressed(ButtonAction::clutch, buttons)) return rest();
    wanted_ = wanted_for(state, grip);
    is_joined_ = was_joined_ = true;
    const auto is_new = [&](ButtonAction action) { return is_pressed(action, buttons) && !is_pressed(action, before); };
    presses_ = {.is_driving = !has_drive_button_ || is_pressed(ButtonAction::drive, buttons),
                .wants_next = is_new(ButtonAction::next),
                .wants_undo = is_new(ButtonAction::undo)};
    return {.world_from_handle = wanted_};
}

kerf_device_command DeviceHand::command(const TickResult& result, std::uint64_t tick) noexcept {
    last_command_ = result.command;
    const bool has_force = !result.is_closed_or_closing && !result.is_coming_back;
    const Vec3 shaft = rotate(result.world_from_tool.rotation, {0, 0, 1});
    return {.tick = tick,
            .force = frame_.to_device(linear(result.command.wrench)),
            .torque = frame_.to_device(angular(result.command.wrench)),
            .device_from_tool = frame_.to_device(result.world_from_tool),
            .flags = (was_joined_ ? std::uint32_t{KERF_DEVICE_RUNNING} : 0u) |
                     (has_force ? std::uint32_t{KERF_DEVICE_FORCE_ON} : 0u),
            .reserved = 0,
            .turn_torque = has_knob_motor_ ? dot(angular(result.command.wrench), shaft) : 0.0};
}

}  // namespace kerf::run
