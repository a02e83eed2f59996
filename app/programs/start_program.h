// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/commands.h"
#include "app/exit_code.h"
#include "app/options.h"

namespace kerf::app {

/// `kerf window`: shows the start page, and the operations and debriefs that the user starts on it, in one window until
/// the user closes it.   [main]
[[nodiscard]] ExitCode run_start_page(const WindowOptions& options, const Environment& with);

}  // namespace kerf::app
