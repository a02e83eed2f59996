// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "core/field/body.h"
#include "core/haptics/tool.h"
#include "core/procedure/procedure.h"
#include "core/procedure/source.h"
#include "core/procedure/step_monitor.h"

/// What a procedure asks of screws and taps, each complaint at its place in the document.
namespace kerf {

/// Refuses a screw without a hole, with a core that is wider than its hole, after a tap of another lead, or whose head
/// seats before its goal is reached (E0511, E0512, E0513, E0515). `tools`: one for each step. None of it needs the
/// bone. [main]
void check_threads(const Procedure& procedure, const std::vector<const ToolOutline*>& tools, Diagnostics& diagnostics);

/// Refuses a screw that leaves the bone at its far end when its head seats, unless its step's goal is as deep (E0514).
/// @param frame   of the step   [main]
void check_length_in_bone(const Procedure& procedure, std::size_t step, const ToolOutline& tool, const AxisFrame& frame,
                          const Body& body, Diagnostics& diagnostics);

}  // namespace kerf
