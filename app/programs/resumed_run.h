// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/options.h"
#include "app/standard_streams.h"

namespace kerf::app {

/// Returns whether the mouse can continue a run of these options: not an examination, nor one with another device.
[[nodiscard]] inline bool can_be_resumed(const RunOptions& options) {
    return options.mode != "exam" && (options.device.empty() || options.device == "mouse");
}

/// Returns the options of a run by mouse that continues a run of these options.
/// @param folder  of the results of that run
/// @param time    [s] from which on
[[nodiscard]] inline RunOptions resumed(RunOptions options, const std::string& folder, double time) {
    options.parent = folder + "/session.db";
    options.at = formatted("%.3f", time);
    options.device = "mouse";
    options.mode = "practice";
    options.screenshot.clear();
    return options;
}

}  // namespace kerf::app
