// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "kerf/device_driver.hpp"

namespace kerf::openhaptics {

/// Touch, Touch X, Omni and Phantom of 3D Systems, through the maker's libHD, which is opened when the driver runs. One
/// device at a time.
///
/// Frame `device`: axes and origin of libHD, +x right, +y up, +z towards the user. The handle is the middle of the
/// gimbal; its axes are those of the stylus. Torques are not made. Gravity is not compensated.
///
/// Settings of the station: `library`, a file or folder with libHD; `device_name`, the name that the maker's setup
/// program gave the device.
struct OpenHaptics {
    double wait;  ///< [s] for a calibration

    static constexpr auto about() {
        using namespace literals;
        return describe("openhaptics", "Touch, Touch X, Omni and Phantom, through the library of 3D Systems.",
                        param(&OpenHaptics::wait, {.id = "wait",
                                                   .help = "Maximum time to wait for the calibration of the device.",
                                                   .unit = unit::s,
                                                   .min = 0.1_s,
                                                   .max = 600.0_s,
                                                   .def = 30.0_s,
                                                   .source = "assumed"}));
    }
    /// Returns the device that libHD opens by default, with its problem if it cannot be opened; none without libHD.
    [[nodiscard]] std::vector<DeviceFound> find() const;
    /// Throws std::runtime_error with the reason if there is no usable device.
    [[nodiscard]] std::unique_ptr<DeviceLink> open(const DeviceRequest& request) const;
};

}  // namespace kerf::openhaptics
