// SPDX-License-Identifier: Apache-2.0
#include "kerf/device_driver.hpp"
#include "pedal.h"

KERF_PLUGIN("kerf.pedal", "0.1.0", "Apache-2.0", kerf::pedal::Pedal)
