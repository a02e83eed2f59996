// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "devices/hid/hid_transport.h"
#include "kerf/device_driver.hpp"

namespace kerf::hid_force {

/// How a wheel is set up.
struct WheelSetup {
    double full_scale_torque = 0.0;                     ///< [N·m] of the largest magnitude; 0: not stated
    double range = 0.0;                                 ///< [rad] from the smallest to the largest count; 0: not stated
    double peak_torque = 0.0, continuous_torque = 0.0;  ///< [N·m]
    bool is_reversed = false;                           ///< counts rise counter-clockwise
    bool is_torque_reversed = false;                    ///< its magnitude has the sign that the class does not mean
};

/// Returns the connected devices with force feedback, each with its problem if it cannot be opened.   [main]
/// @param transport  null: this build lacks hidapi, and the one found device has that problem
[[nodiscard]] std::vector<DeviceFound> find_wheels(hid::HidTransport* transport);

/// Opens a device with force feedback and starts its force, at zero. Throws std::runtime_error with the reason if it
/// cannot.   [main]
///
/// One thread sends and another one reads. Closing waits 0.1 s for the zero force at most. A write that blocks longer
/// keeps its thread and the transport until it returns; the device itself ends the force after `effect_duration`.
[[nodiscard]] std::unique_ptr<DeviceLink> open_wheel(std::unique_ptr<hid::HidTransport> transport,
                                                     const WheelSetup& setup, const DeviceRequest& request);

}  // namespace kerf::hid_force
