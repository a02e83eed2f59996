// SPDX-License-Identifier: Apache-2.0
#include "spacemouse.h"

#include <algorithm>
#include <cstdint>
#include <iterator>

#include "deflections.h"
#include "devices/hid/hid_driver.h"

namespace kerf::spacemouse {

namespace {

constexpr std::uint16_t logitech = 0x046d, connexion = 0x256f;  // which made and makes them
constexpr std::uint16_t generic_desktop = 0x01, multi_axis_controller = 0x08;

// SpaceNavigator, its notebook version, Wireless by cable and by receiver, Compact, Wireless BT.
constexpr std::uint16_t with_two_buttons[] = {0xc626, 0xc628, 0xc62e, 0xc62f, 0xc635, 0xc63a};
constexpr std::uint32_t many_buttons = 27;  // of a SpaceMouse Pro, whose numbers have gaps

/// The same makers' mice and keyboards are no multi-axis controllers.
bool is_spacemouse(const hid::HidEntry& entry) {
    return (entry.vendor == logitech || entry.vendor == connexion) && entry.usage_page == generic_desktop &&
           entry.usage == multi_axis_controller;
}

kerf_device_facts facts_of(const hid::HidEntry& entry) {
    kerf_device_facts facts{};
    facts.abilities = KERF_DEVICE_DEFLECTION;
    const bool has_two = std::find(std::begin(with_two_buttons), std::end(with_two_buttons), entry.product) !=
                         std::end(with_two_buttons);
    facts.button_count = has_two ? 2 : many_buttons;
    return facts;
}

}  // namespace

hid::HidModel model() {
    return {.name = "SpaceMouse", .is_one = &is_spacemouse, .facts = &facts_of, .decoder = [] {
                return std::unique_ptr<hid::ReportDecoder>(std::make_unique<Deflections>());
            }};
}

std::vector<DeviceFound> SpaceMouse::find() const {
    return hid::find_devices(model(), hid::make_hidapi_transport().get());
}

std::unique_ptr<DeviceLink> SpaceMouse::open(const DeviceRequest& request) const {
    return hid::open_device(model(), hid::make_hidapi_transport(), request);
}

}  // namespace kerf::spacemouse
