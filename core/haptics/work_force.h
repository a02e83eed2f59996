// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/field/body.h"
#include "core/haptics/simulation.h"

namespace kerf {

/// The force along the tool's axis that a plugin's law asks for in the body's hardest tissue, all edges in bone, at a
/// steady `feed_rate` [m/s]: what the device's force scale is set by. [N]
///
/// "Hardest" is whichever material gives the largest force.   [main]
[[nodiscard]] double work_force(const ToolSetup& setup, const Body& body, double feed_rate);

}  // namespace kerf
