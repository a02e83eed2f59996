// SPDX-License-Identifier: Apache-2.0
#include "kerf/device_driver.hpp"
#include "openhaptics.h"

KERF_PLUGIN("kerf.openhaptics", "0.1.0", "Apache-2.0", kerf::openhaptics::OpenHaptics)
