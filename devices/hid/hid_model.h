// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "devices/hid/hid_transport.h"
#include "devices/hid/report_decoder.h"
#include "kerf/device.h"

namespace kerf::hid {

/// One kind of devices.
struct HidModel {
    const char* name;                       ///< for people: "SpaceMouse"
    bool (*is_one)(const HidEntry& entry);  ///< whether an entry is one of them
    kerf_device_facts (*facts)(const HidEntry& entry);
    std::unique_ptr<ReportDecoder> (*decoder)();
};

/// A connected device of a kind, with an id that lasts from run to run.
struct HidDevice {
    std::string id;  ///< its serial number, or else vendor and product, and from the second on a number
    HidEntry entry;
};

/// Returns the devices of a kind among the entries, each path once, in the order of their paths.   [any] pure
[[nodiscard]] std::vector<HidDevice> devices_of(const HidModel& model, const std::vector<HidEntry>& entries);

}  // namespace kerf::hid
