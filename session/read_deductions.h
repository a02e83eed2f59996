// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "session/recording.h"

namespace kerf::session {

/// Returns the deductions in the text of a `summary.json`; none in one that has none or is no JSON. Skips what is no
/// deduction.   [any]
[[nodiscard]] std::vector<DeductionRow> read_deductions(const std::string& summary);

}  // namespace kerf::session
