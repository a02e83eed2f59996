// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "core/field/grid/body.h"
#include "core/haptics/law/tool.h"
#include "documents/procedure.h"
#include "run/verdict/step_monitor.h"
#include "text/source.h"

/// What a procedure asks of screws and taps, each complaint at its place in the document.
namespace kerf {

/// Refuses a screw with a core that is wider than its hole, in a hole or after a tap as wide as its thread, after a tap
/// of another lead, or whose head seats before its goal is reached; and releases of what is no implant (E0512, E0513,
/// E0515, E0517, E0518). `tools`: one for each step. None of it needs the bone.   [main]
void check_threads(const Procedure& procedure, const std::vector<const ToolOutline*>& tools, Diagnostics& diagnostics);

/// Refuses a screw or a tap without a hole, drilled before or in the bone, and a screw that leaves the bone at its far
/// end when its head seats, unless its step's goal is as deep (E0511, E0514).
/// @param frame   of the step   [main]
void check_screw_in_bone(const Procedure& procedure, const std::vector<const ToolOutline*>& tools, std::size_t step,
                         const AxisFrame& frame, const Body& body, Diagnostics& diagnostics);

}  // namespace kerf
