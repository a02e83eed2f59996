// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "documents/station.h"
#include "kerf/device.h"
#include "kerf/device.hpp"
#include "run/button_presses.h"
#include "run/device/aimed_hand.h"
#include "run/device/handle_frame.h"

namespace kerf {
struct TickResult;
}  // namespace kerf

namespace kerf::run {

/// A hand at a device: turns its reports into samples of the loop, and the loop's results into forces.
///
/// A device that is silent for 20 ms, not valid, or clutched, is lost to the loop: the force fades. The handle is
/// joined to the tool again when it returns.
///
/// The turn of a knob adds to that of the handle, about the shaft of the tool, clockwise for who looks along it. The
/// torque about the shaft then goes to the knob.
///
/// A device that senses a deflection moves the aim of a simulated hand, which then takes the force. Its silence is
/// rest: it is lost only while it is not valid.
class DeviceHand {
public:
    /// @param arm  of the simulated hand; only for a device that senses a deflection
    DeviceHand(const documents::DeviceStation& station, const kerf_device_facts& facts, const Pose& world_from_tool,
               const Arm& arm = {});

    /// Takes the newest report. Returns the sample for the loop.   [haptic, nonblocking]
    /// @param grip  point of the tool that the hand grips, tool frame [m]
    [[nodiscard]] DeviceSample take(const kerf_device_state& state, Vec3 grip) noexcept;
    [[nodiscard]] const ButtonPresses& presses() const noexcept { return presses_; }
    /// Returns the command for the device.   [haptic, nonblocking]
    [[nodiscard]] kerf_device_command command(const TickResult& result, std::uint64_t tick) noexcept;
    /// Returns whether the device has been silent for this number of ticks.
    [[nodiscard]] bool is_silent(std::uint64_t ticks) const noexcept { return lost_ticks_ >= ticks; }

private:
    [[nodiscard]] bool is_pressed(documents::ButtonAction action, std::uint32_t buttons) const noexcept;

    [[nodiscard]] bool is_there(const kerf_device_state& state) const noexcept;
    [[nodiscard]] DeviceSample rest() noexcept;
    /// Returns the pose that the hand wants for the tool.
    [[nodiscard]] Pose wanted_for(const kerf_device_state& state, Vec3 grip) noexcept;
    [[nodiscard]] Pose turned(const Pose& tool, double turn) const noexcept;

    documents::DeviceStation station_;
    HandleFrame frame_;
    std::optional<AimedHand> aimed_{};  ///< of a device that senses a deflection
    DeviceCommand last_command_{};      ///< which the simulated hand feels
    std::uint32_t pressable_;           ///< the buttons that the device has
    bool has_drive_button_;
    bool has_knob_motor_;
    double turn_at_join_ = 0.0;  ///< [rad] of the knob, when the handle was joined to the tool
    bool is_joined_ = false, was_joined_ = false;
    Vec3 grip_{};
    Pose wanted_;                             ///< last sample
    std::optional<std::uint32_t> buttons_{};  ///< of the last report
    std::uint64_t lost_ticks_ = 0;
    ButtonPresses presses_;
};

}  // namespace kerf::run
