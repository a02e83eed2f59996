// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "run/device/opened_device.h"

namespace kerf::app {

/// Returns the name by which a user selects a listed device: its driver, with the id of the device if it has one.
[[nodiscard]] inline std::string name_of(const run::ListedDevice& device) {
    return device.id.empty() ? device.driver : device.driver + "/" + device.id;
}

}  // namespace kerf::app
