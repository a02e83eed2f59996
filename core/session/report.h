// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/session/drawn_surface.h"
#include "core/session/recording.h"

namespace kerf {

/// The run as one HTML page for people: verdict, metrics, steps, plots, the bone in 3D. It needs no network, and
/// without scripts it still shows everything but the moving parts. At most 20 000 rows are drawn; extremes are kept.
/// @param bone_after   the surface when the run ended; empty: the page says that there is none
[[nodiscard]] std::string report_html(const RunSummary& summary, const std::vector<TickRow>& rows,
                                      const std::vector<EventRow>& events, const DrawnSurface& bone_after);  // [any]

}  // namespace kerf
