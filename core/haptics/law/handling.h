// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/haptics/law/compliance.h"

namespace kerf {

/// How a tool is held: where, in how many hands, and how its shaft bends.
struct Handling {
    double grip_z = 0.0;  ///< [m]
    int hands = 1;        ///< 1 or 2
    TipBending bending{};
};

}  // namespace kerf
