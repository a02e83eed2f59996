// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "session/recording.h"

namespace kerf::session {

/// Returns the contents of summary.json, schema 1, a stable format for scripts. The keys name their units, mm and s; a
/// metric's value is in its own `unit`. Values that are not finite become `null`.   [any]
[[nodiscard]] std::string summary_json(const RunSummary& summary);

}  // namespace kerf::session
