// SPDX-License-Identifier: Apache-2.0
#include "kerf/device_driver.hpp"
#include "replay.h"

KERF_PLUGIN("kerf.replay", "0.1.0", "Apache-2.0", kerf::replay::Replay)
