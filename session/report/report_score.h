// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "session/recording.h"

namespace kerf::session {

/// Returns the section that shows what the score lost, as HTML; empty if it lost nothing, or if the session states no
/// deductions.   [any]
[[nodiscard]] std::string score_html(const RunSummary& summary);

}  // namespace kerf::session
