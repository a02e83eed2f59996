// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "session/recording.h"
#include "session/report/drawn_run.h"
#include "session/report/recorded_procedure.h"

namespace kerf::session {

/// Returns a run as one HTML page for people: verdict and reasons, the bone in 3D, forces, holes and screws, steps with
/// goals and limits, checks of the simulation. The page needs no network. Without scripts it lacks only the plots over
/// time and the 3D view. It draws at most 20 000 rows, with all extremes. Without bone, the page has a sentence about
/// it. [any]
/// @param procedure   titles and bounds; without them the page has ids, and metrics without bounds
[[nodiscard]] std::string report_html(const RunSummary& summary, const DrawnRun& run,
                                      const RecordedProcedure& procedure = {});

}  // namespace kerf::session
