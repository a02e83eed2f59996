// SPDX-License-Identifier: Apache-2.0
#include "hid_force.h"

#include <stdexcept>
#include <string>

#include "wheel_link.h"

namespace kerf::hid_force {

namespace {

bool is_yes(const DeviceRequest& request, const char* key) {
    const std::string word = request.setting(key);
    if (word.empty() || word == "no") return false;
    if (word == "yes") return true;
    throw std::runtime_error(std::string("the station's setting `") + key + "` is `" + word.substr(0, 20) +
                             "`. Write yes or no.");
}

}  // namespace

std::vector<DeviceFound> HidForce::find() const { return find_wheels(hid::make_hidapi_transport().get()); }

std::unique_ptr<DeviceLink> HidForce::open(const DeviceRequest& request) const {
    request.require_known_settings({"reverse", "reverse_torque"});
    return open_wheel(hid::make_hidapi_transport(),
                      {.full_scale_torque = full_scale_torque,
                       .range = range,
                       .peak_torque = peak_torque,
                       .continuous_torque = continuous_torque,
                       .is_reversed = is_yes(request, "reverse"),
                       .is_torque_reversed = is_yes(request, "reverse_torque")},
                      request);
}

}  // namespace kerf::hid_force
