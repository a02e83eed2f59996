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

/// What a procedure asks of a run, each complaint at its place in the document.
namespace kerf {

/// Refuses a device without a record, too many instruments, and rehearsals that cannot be carried out; warns of those
/// that stop short of their goals. None of it needs the bone.   [main]
void check_run(const Procedure& procedure, Diagnostics& diagnostics);

/// The plugin refuses an instrument, and `why`.   [main]
void refuse_tool(const Procedure& procedure, const std::string& instrument, const std::string& why,
                 Diagnostics& diagnostics);

/// Reports that the remeshing strategy of an instrument cannot be started, and `why`. The run does without it.   [main]
void report_strategy(const Procedure& procedure, const std::string& instrument, const std::string& why,
                     Diagnostics& diagnostics);

/// The spacing [m] at which a cut is as many voxels wide as it takes: two for a blade's kerf, four for a turning tool's
/// hole.   [any] pure.
[[nodiscard]] double coarsest_spacing(const ToolSolid& cutting);
/// Warns of a blade whose kerf is under two voxels, and of a turning tool whose hole is under four.   [main]
void check_width_of_cut(const Procedure& procedure, const std::string& instrument, const ToolSolid& cutting,
                        Diagnostics& diagnostics);

/// Refuses a sleeve into which the tool does not fit.   [main]
void check_guide(const Procedure& procedure, const Instrument& instrument, const ToolSolid& whole,
                 Diagnostics& diagnostics);

/// Refuses limits that are measured on a hole in a step whose tool is a blade.   [main]
void check_hole_limits(const Procedure& procedure, std::size_t step, const ToolSolid& cutting,
                       Diagnostics& diagnostics);

/// Refuses waypoints of a step that regrip a tool without a thread.
/// @param has_thread   whether the step's tool has one   [main]
void check_regrips(const Procedure& procedure, std::size_t step, bool has_thread, Diagnostics& diagnostics);

/// Warns of a step over most of whose way the forces of the bone [N], scaled, lie below the device's own friction.
/// @param along   one for each stretch of its way in bone; all zero for a tool that does not cut   [main]
void check_felt(const Procedure& procedure, std::size_t step, const std::vector<double>& along,
                const DeviceRecord& device, double force_scale, Diagnostics& diagnostics);

/// Warns of tools that take no force to cut with [N], to which no force scale can be made to fit.   [main]
void check_force_scale(const Procedure& procedure, const DeviceRecord& device, double work_force,
                       Diagnostics& diagnostics);

/// Warns of a rehearsal that expects to pass and whose path takes longer [s] than a run may.   [main]
void check_time(const Procedure& procedure, std::size_t rehearsal, double least_time, Diagnostics& diagnostics);

/// Refuses a blade that is thicker or wider than the region in which bone can be cut.   [main]
void check_blade_fits(const Procedure& procedure, const std::string& instrument, const ToolSolid& cutting,
                      const Region& region, Diagnostics& diagnostics);

/// Warns of waypoints at which what cuts would stand in bone beyond the region in which bone can be cut: there bone
/// stands like a wall.
/// @param frames    one per step
/// @param cutting   the cutting region of each step's tool   [main]
void check_waypoints_in_region(const Procedure& procedure, const std::vector<AxisFrame>& frames,
                               const std::vector<const ToolSolid*>& cutting, const Body& body,
                               Diagnostics& diagnostics);

}  // namespace kerf
