// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "studies/stability/finding.h"
#include "studies/stability/scope.h"
#include "studies/stability/tool_under_test.h"

/// Scenes in which a tool's force is known to fail, one file each. For training and research; not for diagnosis,
/// planning or deciding treatment.
namespace kerf::stability {

// `printed`: the papers' law with its tool, for tests of the law itself; none: those are not applicable.

/// S-04: a shell that is thinner than a tick's way.   [main]
void check_tunnelling(const Scope& scope, const ToolUnderTest& tool, const Report& report);
/// S-05: the law creeps over the grid's cells.   [main]
void check_creep(const Scope& scope, const ToolUnderTest& tool, const ToolUnderTest* printed, const Report& report);
/// S-06: counts of the encoder against a slow feed, and against none.   [main]
void check_noise(const Scope& scope, const ToolUnderTest& tool, const Report& report);
/// S-07: a probe lies flat on bone, then has twice as many points.   [main]
void check_flat(const Scope& scope, const Report& report);
/// S-12: out of a hole and into it again.   [main]
void check_re_entry(const Scope& scope, const ToolUnderTest& tool, const ToolUnderTest* printed, const Report& report);
/// S-15: through a shell of 1 mm into air.   [main]
void check_breakthrough(const Scope& scope, const ToolUnderTest& tool, const Report& report);
/// S-16: across a border behind which bone resists a tenth.   [main]
void check_border(const Scope& scope, const ToolUnderTest& tool, const ToolUnderTest* printed, const Report& report);
/// S-17: many points meet a plane at once.   [main]
void check_many_contacts(const Scope& scope, const Report& report);
/// S-19: the motor is switched off under a push.   [main]
void check_switching_off(const Scope& scope, const ToolUnderTest& tool, const Report& report);
/// S-20: a screw is turned in by a hand, held, backed off, turned in again and stripped; and turned in with ticks of
/// another length.   [main]
void check_screw(const Scope& scope, const ToolUnderTest& screw, const Report& report);
/// S-21: the loop misses ticks while a hand moves on a wall.   [main]
void check_missed_ticks(const Scope& scope, const Report& report);
/// P5: the same way with ticks of another length, with each of the papers' laws and with the tool's.   [main]
void check_loop_rate(const Scope& scope, const ToolUnderTest& tool, std::span<const ToolUnderTest> printed,
                     const Report& report);
/// A9: a lever cycle gives no work.   [main]
void check_lever(const Scope& scope, const Report& report);

}  // namespace kerf::stability
