// SPDX-License-Identifier: Apache-2.0
#include "documents/station.h"

#include <algorithm>

namespace kerf::documents {

Quat DeviceStation::world_from_device() const noexcept {
    const Quat to_right = quat_between({1, 0, 0}, right);
    const Vec3 turned = rotate(to_right, {0, 1, 0});
    const Quat to_up = dot(turned, up) < -0.5 ? Quat{0.0, right.x, right.y, right.z} : quat_between(turned, up);
    return normalized(to_up * to_right);
}

void DeviceStation::append_buttons(const DeviceStation& of_pedal, std::size_t own_count) noexcept {
    for (std::size_t i = own_count; i < max_buttons; ++i) buttons[i] = of_pedal.buttons[i - own_count];
}

DeviceStation Station::of(const std::string& device) const {
    const std::string driver = device.substr(0, device.find('/'));
    for (const std::string& name : {device, driver, driver.substr(driver.rfind('.') + 1)}) {
        const auto found =
            std::find_if(devices.begin(), devices.end(), [&](const DeviceStation& one) { return one.device == name; });
        if (found == devices.end()) continue;
        DeviceStation entry = *found;
        entry.device = device;
        return entry;
    }
    return {.device = device};
}

}  // namespace kerf::documents
