// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "kerf/device_driver.hpp"
#include "simulated_hand.h"

namespace kerf::simulated_hand {

/// Returns the arm at the handle of the driver's device, which has no friction: a constant force moves the handle by
/// the force over the arm's stiffness.   [any] pure
[[nodiscard]] Plant plant_of_device() noexcept;

/// A simulated arm that grips a handle and follows a motion under the forces of the device. The station names the
/// motion's file as `motion`; without one the arm keeps the handle at the origin.
///
/// Each command of a tick moves arm and motion by one millisecond. So the same commands give the same reports.
struct HandDevice {
    static constexpr auto about() {
        return describe(
            "simulated_hand",
            "An arm without hardware that grips a handle and moves it by the file `motion` of the station.");
    }
    /// Returns nothing, so that `kerf devices setup` prefers hardware. The device opens without an id.
    [[nodiscard]] std::vector<DeviceFound> find() const { return {}; }
    /// Throws std::runtime_error with the reason if the motion cannot be read.
    [[nodiscard]] std::unique_ptr<DeviceLink> open(const DeviceRequest& request) const;
};

}  // namespace kerf::simulated_hand
