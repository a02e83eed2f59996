// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

/// The devices whose force a person has confirmed at this table: a small file next to the station's.
namespace kerf::app {

/// Returns whether the force of a device was confirmed.   [main]
/// @param device  its driver and name, as `OpenedDevice::name` returns it
[[nodiscard]] bool is_confirmed(const std::string& device);
/// Adds a device. Returns the error as text, empty on success.   [main]
[[nodiscard]] std::string confirm(const std::string& device);

}  // namespace kerf::app
