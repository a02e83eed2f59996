// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/session/drawn_run.h"
#include "core/session/recording.h"

namespace kerf {

/// The run as one HTML page for people: verdict, metrics, steps, plots, the bone in 3D. It needs no network, and
/// without scripts it still shows everything but the moving parts. At most 20 000 rows are drawn; extremes are kept.
/// Where the run has no bone, the page says so.   [any]
[[nodiscard]] std::string report_html(const RunSummary& summary, const DrawnRun& run);

}  // namespace kerf
