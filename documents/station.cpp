// SPDX-License-Identifier: Apache-2.0
#include "documents/station.h"

#include <algorithm>
#include <iterator>

#include "text/quantity.h"

namespace kerf::documents {

namespace {

std::string name_of_side(Vec3 direction) {
    const auto* const found =
        std::find_if(std::begin(sides), std::end(sides), [&](const auto& one) { return one.second == direction; });
    return found != std::end(sides) ? found->first : "none";
}

std::string in_mm(Vec3 p) {
    return text::quantity_text(p.x, "mm") + " " + text::quantity_text(p.y, "mm") + " " + text::quantity_text(p.z, "mm");
}

}  // namespace

Quat DeviceStation::world_from_device() const noexcept {
    const Quat to_right = quat_between({1, 0, 0}, right);
    const Vec3 turned = rotate(to_right, {0, 1, 0});
    const Quat to_up = dot(turned, up) < -0.5 ? Quat{0.0, right.x, right.y, right.z} : quat_between(turned, up);
    return normalized(to_up * to_right);
}

std::string DeviceStation::text() const {
    std::string actions;
    std::size_t count = max_buttons;
    while (count > 0 && buttons[count - 1] == ButtonAction::none) --count;
    for (std::size_t i = 0; i < count; ++i) {
        const auto* const action = std::find_if(std::begin(button_actions), std::end(button_actions),
                                                [&](const auto& one) { return one.second == buttons[i]; });
        actions += (actions.empty() ? "" : ", ") + std::string(action->first);
    }
    return "axes: {right: " + name_of_side(right) + ", up: " + name_of_side(up) +
           "}; scale: " + text::quantity_text(scale, "") +
           (workspace ? "; workspace: {from: " + in_mm(workspace->low) + ", to: " + in_mm(workspace->high) + "}" : "") +
           (handle.is_none()
                ? ""
                : "; handle: {grip: " + in_mm(handle.grip) + ", mass: " + text::quantity_text(handle.mass, "g") + "}") +
           "; speed: " + text::quantity_text(speed, "mm/s") +
           "; turn_speed: " + text::quantity_text(turn_speed, "deg/s") +
           "; dead_zone: " + text::quantity_text(dead_zone, "") + "; buttons: [" + actions + "]" +
           (pedal.empty() ? "" : "; pedal: " + pedal) + (knob.empty() ? "" : "; knob: " + knob);
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
