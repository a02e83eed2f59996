// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/field/cut_field.h"
#include "core/field/tool_solid.h"

namespace kerf {

/// A straight stretch of a tool's path: the solid moves from one pose to another.
struct CutStretch {
    Pose from{}, to{};  ///< body_from_tool
    std::uint16_t solid = 0;
};

/// Joins records into straight stretches: no point of the solid is farther than `tolerance` [m] from where it was in
/// the records. Records must be in order. A path that turns back, a record that does not continue the previous one, and
/// a turn that the hull of both ends would not cover to twice the tolerance start a new stretch.   [any] pure.
/// @param solids   by the records' numbers
[[nodiscard]] std::vector<CutStretch> stretches_of(const std::vector<CutRecord>& records,
                                                   const std::vector<const ToolSolid*>& solids, double tolerance);

/// Leaves out the stretches that only pass where others, before them, have: on the way back through a slot, or in the
/// air. Points on the surface of the solid, at most `apart` [m] from each other, are compared with what was swept
/// before, grown by `tolerance` [m].   [any] pure.
[[nodiscard]] std::vector<CutStretch> without_covered(const std::vector<CutStretch>& stretches,
                                                      const std::vector<const ToolSolid*>& solids, double tolerance,
                                                      double apart);

}  // namespace kerf
