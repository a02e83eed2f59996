// SPDX-License-Identifier: Apache-2.0
#include "haply.h"
#include "kerf/device_driver.hpp"

KERF_PLUGIN("kerf.haply", "0.1.0", "Apache-2.0", kerf::haply::Haply)
