// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/commands.h"
#include "app/exit_code.h"

namespace kerf::app {

/// `kerf devices doctor`: prints the limits of the system and what keeps a device from working.   [main]
[[nodiscard]] ExitCode report_health(const Environment& with);

}  // namespace kerf::app
