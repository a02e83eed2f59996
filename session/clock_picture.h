// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "session/recording.h"

namespace kerf::session {

/// Returns a drawing of a run's clock as SVG: histograms of lateness and computing time, and a table of the slowest
/// ticks with their causes.   [any] pure.
[[nodiscard]] std::string clock_svg(const RunSummary& summary, const ClockRow& clock);

}  // namespace kerf::session
