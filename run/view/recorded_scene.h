// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "run/view/viewed_run.h"
#include "session/report/read_run.h"

/// The part of a scene that a session stores.
namespace kerf::run {

/// Returns the title, tissues, tools and steps of a recorded run. Each tool is a pointer with the diameter of its
/// instrument, if the record has one. There are no plans, zones and implants.   [main]
[[nodiscard]] ViewedScene recorded_scene(const session::RecordedRun& run);

/// Returns the zones of a run at its end.   [main]
[[nodiscard]] std::vector<ViewedZone> recorded_zones(const session::RunSummary& summary);

/// Returns the index of the goal or limit with a name that events use; `demands.size()` if there is none.   [any] pure
[[nodiscard]] std::size_t index_of(const std::vector<session::RecordedDemand>& demands, const std::string& name);

}  // namespace kerf::run
