// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "core/field/grid/body.h"
#include "core/haptics/law/tool.h"
#include "documents/procedure.h"
#include "run/verdict/step_monitor.h"
#include "text/source.h"

/// Requirements on screws and taps. Each diagnostic has its position in the document.
namespace kerf::run {

/// Refuses screws that do not fit the hole before them (E0512, E0513, E0515, E0517): a core wider than the hole, a
/// thread no wider than its hole or tap, a tap of another lead, or a head that seats before the goal. Refuses releases
/// of tools that are no implant (E0518). Needs no bone.
/// @param tools   one for each step   [main]
void check_threads(const documents::Procedure& procedure, const std::vector<const ToolOutline*>& tools,
                   text::Diagnostics& diagnostics);

/// Refuses a screw or tap without a hole, which may be drilled or in the bone (E0511). Refuses a screw that would leave
/// the bone at the far end when its head seats, unless the goal is as deep (E0514), or whose thread is wider than the
/// bone around it (E0530).
/// @param frame   of the step   [main]
void check_screw_in_bone(const documents::Procedure& procedure, const std::vector<const ToolOutline*>& tools,
                         std::size_t step, const AxisFrame& frame, const Body& body, text::Diagnostics& diagnostics);

}  // namespace kerf::run
