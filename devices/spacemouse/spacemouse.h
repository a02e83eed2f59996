// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "devices/hid/hid_model.h"
#include "kerf/device_driver.hpp"

namespace kerf::spacemouse {

/// Returns the kind of devices that this driver takes.   [any]
[[nodiscard]] hid::HidModel model();

/// A cap with six axes that springs back to rest: a SpaceMouse, SpaceNavigator or their like. It makes no force. Its
/// deflection moves the aim of the simulated hand (docs/guide/devices.md).
struct SpaceMouse {
    static constexpr auto about() {
        return describe("spacemouse", "A SpaceMouse: its cap moves the aim of the simulated hand, without force.");
    }
    [[nodiscard]] std::vector<DeviceFound> find() const;
    [[nodiscard]] std::unique_ptr<DeviceLink> open(const DeviceRequest& request) const;
};

}  // namespace kerf::spacemouse
