// SPDX-License-Identifier: Apache-2.0
#include "kerf/device_driver.hpp"
#include "udp_device.h"

KERF_PLUGIN("kerf.udp", "0.1.0", "Apache-2.0", kerf::udp::Udp)
