// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "session/recording.h"

namespace kerf::session {

/// Returns an exact surface as an object of summary.json and remesh.json. The keys name their unit, mm.   [any] pure.
[[nodiscard]] nlohmann::ordered_json exact_summary(const ExactRow& exact);

}  // namespace kerf::session
