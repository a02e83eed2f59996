// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "run/view/viewed_run.h"
#include "session/recording.h"

namespace kerf::run {

/// Returns the result of a run for a viewer, its deductions with the largest first.   [any] pure
/// @param folder  of the results, for people; empty: none
[[nodiscard]] ViewedResult viewed_result(const session::RunSummary& summary, const std::string& folder);

}  // namespace kerf::run
