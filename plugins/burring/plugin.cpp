// SPDX-License-Identifier: Apache-2.0
#include "kerf/plugin.hpp"

#include "burr_force.h"
#include "displace/displace_strategy.h"

KERF_PLUGIN("kerf.burring", "0.1.0", "Apache-2.0", kerf::burring::RoundBurr, kerf::burring::CylindricalBurr,
            kerf::burring::PearBurr, kerf::burring::BurrCutting, kerf::burring::Displace)
