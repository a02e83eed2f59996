// SPDX-License-Identifier: Apache-2.0
#include "kerf/device_driver.hpp"
#include "spacemouse.h"

KERF_PLUGIN("kerf.spacemouse", "0.1.0", "Apache-2.0", kerf::spacemouse::SpaceMouse)
