// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "devices/hid/hid_model.h"
#include "kerf/device_driver.hpp"

namespace kerf::pedal {

/// Returns the kind of devices that this driver takes.   [any]
[[nodiscard]] hid::HidModel model();

/// An Infinity foot pedal: three buttons, for the foot of a hand at another device (docs/guide/devices.md).
struct Pedal {
    static constexpr auto about() {
        return describe("pedal", "An Infinity foot pedal: three buttons beside those of another device.");
    }
    [[nodiscard]] std::vector<DeviceFound> find() const;
    [[nodiscard]] std::unique_ptr<DeviceLink> open(const DeviceRequest& request) const;
};

}  // namespace kerf::pedal
