// SPDX-License-Identifier: Apache-2.0
#include "kerf/plugin.hpp"

#include "screw_force.h"

KERF_PLUGIN("kerf.implant", "0.2.0", "Apache-2.0", kerf::implant::PedicleScrew, kerf::implant::BoneScrew,
            kerf::implant::DentalImplant, kerf::implant::Tap, kerf::implant::ScrewInsertion)
