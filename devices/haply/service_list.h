// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "kerf/device_driver.hpp"

namespace kerf::haply {

/// Returns the arms that a service on this machine lists, each with its problem if it cannot be used; none if there is
/// no service. Takes at most half a second.   [main]
[[nodiscard]] std::vector<DeviceFound> list_arms(std::uint16_t port);

}  // namespace kerf::haply
