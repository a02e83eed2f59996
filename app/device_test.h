// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/exit_code.h"
#include "core/plugin/loader.h"

namespace kerf::app {

/// `kerf devices test`: watches a device for 10 s, without force, and prints what it reported.   [main]
[[nodiscard]] ExitCode test_device(const std::string& id, const PluginRegistry& plugins);

}  // namespace kerf::app
