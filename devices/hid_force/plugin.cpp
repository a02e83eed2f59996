// SPDX-License-Identifier: Apache-2.0
#include "hid_force.h"
#include "kerf/device_driver.hpp"

KERF_PLUGIN("kerf.hid_force", "0.1.0", "Apache-2.0", kerf::hid_force::HidForce)
