// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/field/cut/tool_solid.h"
#include "core/field/grid/body.h"
#include "core/field/grid/region.h"
#include "core/haptics/loop/device_record.h"
#include "documents/procedure.h"
#include "run/verdict/step_monitor.h"
#include "text/source.h"

/// Requirements of a procedure on a run. Each diagnostic has its position in the document.
namespace kerf::run {

/// Refuses a device without a record, too many instruments, and rehearsals that cannot be carried out. Warns of
/// rehearsals that end short of their goals. Needs no bone.   [main]
void check_run(const documents::Procedure& procedure, text::Diagnostics& diagnostics);

/// Reports that the plugin refuses an instrument, with the reason `why`.   [main]
void refuse_tool(const documents::Procedure& procedure, const std::string& instrument, const std::string& why,
                 text::Diagnostics& diagnostics);

/// Reports that the remeshing strategy of an instrument cannot be started, with the reason `why`. The run continues
/// without it.   [main]
void report_strategy(const documents::Procedure& procedure, const std::string& instrument, const std::string& why,
                     text::Diagnostics& diagnostics);

/// Returns the largest spacing [m] at which a cut is wide enough in voxels: two for a blade's kerf, four for a turning
/// tool's hole.   [any] pure.
[[nodiscard]] double coarsest_spacing(const ToolSolid& cutting);
/// Warns of a blade with a kerf under two voxels, and of a turning tool with a hole under four.   [main]
void check_width_of_cut(const documents::Procedure& procedure, const std::string& instrument, const ToolSolid& cutting,
                        text::Diagnostics& diagnostics);

/// Refuses a sleeve that is too narrow for the tool.   [main]
void check_guide(const documents::Procedure& procedure, const documents::Instrument& instrument, const ToolSolid& whole,
                 text::Diagnostics& diagnostics);

/// Refuses limits on a hole in a step with a blade.   [main]
void check_hole_limits(const documents::Procedure& procedure, std::size_t step, const ToolSolid& cutting,
                       text::Diagnostics& diagnostics);

/// Refuses waypoints of a step that turn or regrip a tool without a thread.
/// @param has_thread   whether the step's tool has a thread   [main]
void check_turns(const documents::Procedure& procedure, std::size_t step, bool has_thread,
                 text::Diagnostics& diagnostics);

/// Warns of a step in which most scaled forces of the bone [N] are below the device's own friction.
/// @param along   one force per stretch of the axis in bone; all zero for a tool that does not cut   [main]
void check_felt(const documents::Procedure& procedure, std::size_t step, const std::vector<double>& along,
                const DeviceRecord& device, double force_scale, text::Diagnostics& diagnostics);

/// Warns of tools that need no force to cut [N], for which no force scale can be computed.   [main]
void check_force_scale(const documents::Procedure& procedure, const DeviceRecord& device, double work_force,
                       text::Diagnostics& diagnostics);

/// Warns of a rehearsal that expects to pass but whose path takes longer [s] than the run's limit.   [main]
void check_time(const documents::Procedure& procedure, std::size_t rehearsal, double min_time,
                text::Diagnostics& diagnostics);

/// Refuses a blade that is thicker or wider than the region in which bone can be cut.   [main]
void check_blade_fits(const documents::Procedure& procedure, const std::string& instrument, const ToolSolid& cutting,
                      const Region& region, text::Diagnostics& diagnostics);

/// Warns of waypoints at which the cutting part would be in bone beyond the region in which bone can be cut. That bone
/// acts as a wall.
/// @param frames    one per step
/// @param cutting   the cutting part of each step's tool   [main]
void check_waypoints_in_region(const documents::Procedure& procedure, const std::vector<AxisFrame>& frames,
                               const std::vector<const ToolSolid*>& cutting, const Body& body,
                               text::Diagnostics& diagnostics);

}  // namespace kerf::run
