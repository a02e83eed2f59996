// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/field/cut/tool_solid.h"
#include "core/field/grid/body.h"

namespace kerf {

enum class CutOnly { no, yes };

/// Returns whether a brick that contained bone before any cut comes within `margin` [m] of the solid at this pose. Errs
/// towards true: it tests the solid's box. Bone outside the body's region counts only with CutOnly::no.
/// [any] pure, nonblocking.
[[nodiscard]] bool is_in_reach_of_bone(const Body& body, const ToolSolid& solid, const Pose& body_from_tool,
                                       double margin, CutOnly cut_only = CutOnly::no) noexcept;

}  // namespace kerf
