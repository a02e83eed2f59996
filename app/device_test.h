// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/exit_code.h"
#include "core/plugin/loader.h"

namespace kerf::app {

/// A measurement of a device.
struct DeviceTest {
    std::string id{};
    double seconds = 10.0;  ///< [s]
    std::string record{};   ///< file for the motion of the handle; empty: none
};

/// `kerf devices test`: runs a device without force, and prints what it reported.   [main]
[[nodiscard]] ExitCode test_device(const DeviceTest& test, const PluginRegistry& plugins);

}  // namespace kerf::app
