// SPDX-License-Identifier: Apache-2.0
#include "pedal.h"

#include <cstdint>

#include "devices/hid/hid_driver.h"
#include "report.h"

namespace kerf::pedal {

namespace {

constexpr std::uint16_t vendor = 0x05f3, product = 0x00ff;  // the pedal is sold under several names

/// A pedal sends at each change, so a pressed one may be silent for long.
class Presses final : public hid::ReportDecoder {
public:
    [[nodiscard]] bool take(std::span<const std::uint8_t> report, double /*now*/,
                            kerf_device_state& state) noexcept override {
        const auto buttons = decode(report);
        if (buttons) state.buttons = *buttons;
        return buttons.has_value();
    }
    [[nodiscard]] bool expire(double /*now*/, kerf_device_state& /*state*/) noexcept override { return false; }
};

bool is_pedal(const hid::HidEntry& entry) { return entry.vendor == vendor && entry.product == product; }

kerf_device_facts facts_of(const hid::HidEntry& /*entry*/) {
    kerf_device_facts facts{};
    facts.button_count = button_count;
    return facts;
}

}  // namespace

hid::HidModel model() {
    return {.name = "foot pedal", .is_one = &is_pedal, .facts = &facts_of, .decoder = [] {
                return std::unique_ptr<hid::ReportDecoder>(std::make_unique<Presses>());
            }};
}

std::vector<DeviceFound> Pedal::find() const { return hid::find_devices(model(), hid::make_hidapi_transport().get()); }

std::unique_ptr<DeviceLink> Pedal::open(const DeviceRequest& request) const {
    return hid::open_device(model(), hid::make_hidapi_transport(), request);
}

}  // namespace kerf::pedal
