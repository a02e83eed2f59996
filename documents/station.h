// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/field/grid/box.h"
#include "kerf/device.h"
#include "kerf/math.hpp"

namespace kerf::documents {

/// What a button of a device does. `drive` runs the tool's motor while it is held. `next` carries out the next action
/// of the step. `clutch` keeps the tool where it is while the hand moves the handle elsewhere.
enum class ButtonAction : std::uint8_t { none, drive, next, clutch, undo };

inline constexpr std::pair<const char*, ButtonAction> button_actions[] = {{"none", ButtonAction::none},
                                                                          {"drive", ButtonAction::drive},
                                                                          {"next", ButtonAction::next},
                                                                          {"clutch", ButtonAction::clutch},
                                                                          {"undo", ButtonAction::undo}};

inline constexpr std::size_t max_buttons = KERF_DEVICE_MAX_BUTTONS;

/// Directions of the patient, LPS.
inline constexpr std::pair<const char*, Vec3> sides[] = {{"left", {1, 0, 0}},      {"right", {-1, 0, 0}},
                                                         {"posterior", {0, 1, 0}}, {"anterior", {0, -1, 0}},
                                                         {"superior", {0, 0, 1}},  {"inferior", {0, 0, -1}}};

inline constexpr double min_scale = 0.05;  ///< [–] motion of the tool per motion of the handle

/// What a lab has fixed to the handle of a device.
struct HandleFit {
    Vec3 grip{};        ///< [m] where the hand grips, frame of the handle
    double mass = 0.0;  ///< [kg] at the grip, which the device carries

    [[nodiscard]] bool is_none() const noexcept { return grip == Vec3{} && mass == 0.0; }
    [[nodiscard]] double weight() const noexcept { return 9.81 * mass; }  ///< [N]
};

/// The setup of a device on its table, and its use by a hand.
struct DeviceStation {
    std::string device{};  ///< driver, and the device's id if it matters: "udp", "udp/port-4190"
    /// Directions of the patient (LPS) in which the device's axes +x (right) and +y (up) lead. The default is the view
    /// from behind a standing patient.
    Vec3 right{-1, 0, 0}, up{0, 0, 1};
    double scale = 1.0;  ///< [–] motion of the tool per motion of the handle; with a workspace it is computed
    std::optional<Box> workspace{};  ///< [m] that the handle reaches, frame of the device
    HandleFit handle{};
    /// Of a device without position, at full deflection: speed of the aim [m/s], of its turn [rad/s], each times
    /// `scale`. [assumed]
    double speed = 20e-3, turn_speed = std::numbers::pi / 6.0;
    double dead_zone = 0.1;  ///< [–] deflection that counts as rest [assumed]
    std::array<ButtonAction, max_buttons> buttons{ButtonAction::drive, ButtonAction::next, ButtonAction::clutch,
                                                  ButtonAction::undo};
    std::vector<std::pair<std::string, std::string>> settings{};  ///< of the driver: parameters and texts
    std::string pedal{};  ///< driver, and the device's id if it matters, of a second device for its buttons; or empty
    std::string knob{};   ///< the same of a second device that turns the tool about its shaft; or empty

    /// Returns the rotation from the device's axes to the patient's. Pre: `right` and `up` are perpendicular.   [any]
    [[nodiscard]] Quat world_from_device() const noexcept;
    /// Returns the setup as one line for a record. It contains no path, address or key.   [any]
    [[nodiscard]] std::string text() const;
    /// Appends the actions of a pedal's buttons to those of this device, which has `own_count` buttons.   [any]
    void append_buttons(const DeviceStation& of_pedal, std::size_t own_count) noexcept;
};

/// The devices of one table.
struct Station {
    std::vector<DeviceStation> devices;

    /// Returns the entry of a device, or else of its driver, or else the defaults. It names the device as `device`
    /// does.   [any]
    [[nodiscard]] DeviceStation of(const std::string& device) const;
};

}  // namespace kerf::documents
