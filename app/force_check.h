// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/exit_code.h"
#include "core/plugin/loader.h"

namespace kerf::app {

/// `kerf devices test DEVICE --force`: pushes the handle slowly along each axis, with at most 1 N and half of the
/// continuous force, and lets a person confirm each push on stdin. A push ends at 0.5 m/s, after 50 mm, or when the
/// device is lost. A knob is turned in both directions, with at most 0.1 N m and half of the continuous torque. [main]
[[nodiscard]] ExitCode check_force(const std::string& id, const PluginRegistry& plugins);

}  // namespace kerf::app
