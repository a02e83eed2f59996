// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "kerf/device_driver.hpp"

namespace kerf::force_dimension {

/// Devices of Force Dimension, omega, delta and sigma, and the Falcon of Novint, through the maker's library, which is
/// opened when the driver runs.
///
/// Frame `device`: its origin is that of the library, the middle of the workspace. The handle is the end effector.
/// Torques are not made.
///
/// Settings of the station: `library`, a file or folder with the maker's library; `may_move: yes`, with which the base
/// may move its arm to calibrate itself.
struct ForceDimension {
    static constexpr auto about() {
        return describe("force_dimension", "omega, delta, sigma and Falcon, through the library of Force Dimension.");
    }
    /// Returns the connected devices; none without the library.
    [[nodiscard]] std::vector<DeviceFound> find() const;
    /// Throws std::runtime_error with the reason if there is no usable device.
    [[nodiscard]] std::unique_ptr<DeviceLink> open(const DeviceRequest& request) const;
};

}  // namespace kerf::force_dimension
