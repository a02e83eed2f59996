// SPDX-License-Identifier: Apache-2.0
#include "kerf/plugin.hpp"

#include "drill_force.h"

KERF_PLUGIN("kerf.drilling", "0.1.0", "Apache-2.0", kerf::drilling::TwistBit, kerf::drilling::StepBit,
            kerf::drilling::ProfileBit, kerf::drilling::DrillCutting)
