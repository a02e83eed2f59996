// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "kerf/device_driver.hpp"

namespace kerf::hid_force {

/// A knob or wheel with a motor that speaks USB HID PID 1.0, such as the base of a steering wheel. It senses its turn
/// and makes a torque about its axis. It leads no tool; a station adds it to a device that does (`knob:`).
///
/// Settings of the station, each `yes` or `no`: `reverse`, with which turn and torque change their signs, and
/// `reverse_torque`, with which the torque alone does.
struct HidForce {
    double full_scale_torque;  ///< [N·m] of the largest magnitude; 0: not stated
    double range;              ///< [rad] from the smallest to the largest count of the axis; 0: not stated
    double peak_torque;        ///< [N·m]
    double continuous_torque;  ///< [N·m]

    static constexpr auto about() {
        using namespace literals;
        return describe(
            "hid_force", "A knob or wheel with a motor that speaks USB HID PID.",
            param(&HidForce::full_scale_torque, {.id = "full_scale_torque",
                                                 .help = "Torque at full magnitude, as its maker states. Needed.",
                                                 .unit = unit::N_m,
                                                 .min = 0.0_Nmm,
                                                 .max = 50000.0_Nmm,
                                                 .def = 0.0_Nmm,
                                                 .source = "none: the device does not report it"}),
            param(&HidForce::range, {.id = "range",
                                     .help = "Angle from the smallest to the largest count of its axis. Needed.",
                                     .unit = unit::deg,
                                     .min = 0.0_deg,
                                     .max = 36000.0_deg,
                                     .def = 0.0_deg,
                                     .source = "none: the device does not report it"}),
            param(&HidForce::peak_torque, {.id = "peak_torque",
                                           .help = "Largest torque that Kerf lets it make.",
                                           .unit = unit::N_m,
                                           .min = 1.0_Nmm,
                                           .max = 50000.0_Nmm,
                                           .def = 500.0_Nmm,
                                           .source = "assumed"}),
            param(&HidForce::continuous_torque, {.id = "continuous_torque",
                                                 .help = "Torque that Kerf lets it make for long.",
                                                 .unit = unit::N_m,
                                                 .min = 1.0_Nmm,
                                                 .max = 50000.0_Nmm,
                                                 .def = 250.0_Nmm,
                                                 .source = "assumed"}));
    }
    [[nodiscard]] std::vector<DeviceFound> find() const;
    /// Throws std::runtime_error with the reason if the device cannot be driven.
    [[nodiscard]] std::unique_ptr<DeviceLink> open(const DeviceRequest& request) const;
};

}  // namespace kerf::hid_force
