// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "devices/motion/motion.h"
#include "kerf/device_driver.hpp"

namespace kerf::motion {

/// Reads the file that a station names as `motion`; nothing if it names none. Throws std::runtime_error with file, line
/// and reason if it cannot be read.   [main]
[[nodiscard]] std::optional<Motion> motion_of(const DeviceRequest& request);

/// Throws std::runtime_error unless the request is for any device of a driver: it has one, without an id.   [main]
void require_no_id(const DeviceRequest& request, const std::string& driver);

}  // namespace kerf::motion
