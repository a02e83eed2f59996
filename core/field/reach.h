// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/field/body.h"
#include "core/field/revolution_solid.h"

namespace kerf {

/// Whether any brick that holds bone, cut or not, comes within `margin` [m] of the solid at this pose. Errs towards
/// true. [any] pure, nonblocking.
[[nodiscard]] bool is_in_reach_of_bone(const Body& body, const RevolutionSolid& solid, const Pose& body_from_tool,
                                       double margin) noexcept;

}  // namespace kerf
