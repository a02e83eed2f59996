// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/haptics/law/compliance.h"

namespace kerf {

/// How a tool is held: grip position, number of hands and bending of its shaft.
struct ToolGrip {
    double grip_z = 0.0;  ///< [m] of the grip, tool frame
    int hands = 1;        ///< 1 or 2
    TipBending bending{};
};

}  // namespace kerf
