// SPDX-License-Identifier: Apache-2.0
#include "hand_device.h"
#include "kerf/device_driver.hpp"

KERF_PLUGIN("kerf.simulated_hand", "0.1.0", "Apache-2.0", kerf::simulated_hand::HandDevice)
