// SPDX-License-Identifier: Apache-2.0
// The impulses of [mandibular-angle] with its equations corrected, on the blade of plugins/sawing.
// Its events are those of that plugin, "sawing.…", so its id ends with the same word.
#include "kerf/plugin.hpp"

#include "reciprocating_impulse.h"

KERF_PLUGIN("papers.sawing", "0.1.0", "Apache-2.0", kerf::sawing::ReciprocatingBlade,
            kerf::papers::ReciprocatingImpulse)
