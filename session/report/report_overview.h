// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "session/recording.h"

/// The tables of report.html that compare steps, as HTML.
namespace kerf::session {

/// One row for each hole, and one for each screw or implant. Empty where there is neither.   [any]
[[nodiscard]] std::string holes_html(const RunSummary& summary);

/// One row for each measure of the bone: before the first cut and in the end. Empty without any.   [any]
[[nodiscard]] std::string measures_html(const RunSummary& summary);

}  // namespace kerf::session
