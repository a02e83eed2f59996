// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/exit_code.h"
#include "app/installation.h"
#include "app/options.h"

namespace kerf::app {

/// Runs `kerf landmarks`: in a window, or without one by rays.   [main]
[[nodiscard]] ExitCode run_landmarks(const LandmarksOptions& options, const Installation& here);

}  // namespace kerf::app
