// SPDX-License-Identifier: Apache-2.0
#include "force_dimension.h"
#include "kerf/device_driver.hpp"

KERF_PLUGIN("kerf.force_dimension", "0.1.0", "Apache-2.0", kerf::force_dimension::ForceDimension)
