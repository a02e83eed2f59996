// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/exit_code.h"
#include "app/installation.h"
#include "app/options.h"

namespace kerf::app {

/// `kerf check`: tests plugins in child processes and prints the findings. It loads no plugin itself.
///   [main]
[[nodiscard]] ExitCode check_plugins(const CheckOptions& options, const Installation& here);

}  // namespace kerf::app
