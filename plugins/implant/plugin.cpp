// SPDX-License-Identifier: Apache-2.0
#include "kerf/plugin.hpp"

#include "screw_force.h"

KERF_PLUGIN("kerf.implant", "0.1.0", "Apache-2.0", kerf::implant::PedicleScrew, kerf::implant::ScrewInsertion)
