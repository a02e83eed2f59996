// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "devices/hid/hid_model.h"
#include "devices/hid/hid_transport.h"
#include "kerf/device_driver.hpp"

/// A driver of HID devices that only send. A thread of its own reads them.
namespace kerf::hid {

/// Returns the connected devices of a kind, each with its problem if it cannot be opened.   [main]
/// @param transport  null: this build lacks hidapi, and the one found device has that problem
[[nodiscard]] std::vector<DeviceFound> find_devices(const HidModel& model, HidTransport* transport);

/// Opens a device of a kind. Throws std::runtime_error with the reason if it cannot.   [main]
[[nodiscard]] std::unique_ptr<DeviceLink> open_device(const HidModel& model, std::unique_ptr<HidTransport> transport,
                                                      const DeviceRequest& request);

}  // namespace kerf::hid
