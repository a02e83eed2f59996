// SPDX-License-Identifier: Apache-2.0
#include "kerf/plugin.hpp"

#include "reciprocating_force.h"
#include "saw_force.h"

KERF_PLUGIN("kerf.sawing", "0.1.0", "Apache-2.0", kerf::sawing::OscillatingBlade, kerf::sawing::SawCutting,
            kerf::sawing::ReciprocatingBlade, kerf::sawing::ReciprocatingCutting)
