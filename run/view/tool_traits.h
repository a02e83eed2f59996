// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/haptics/law/tool.h"

/// Values of a tool that its outline leaves open, by the names of docs/guide/plugins.md.
namespace kerf::run {

/// Returns a parameter of a tool [SI]; nothing if it has none of that id and dimension.   [main]
[[nodiscard]] std::optional<double> parameter(const ToolSetup& setup, const char* id, const kerf_dimension& dimension);

/// Returns whether a tool has a drive in turns or strokes per time.   [main]
[[nodiscard]] bool is_powered(const ToolSetup& setup);

/// Returns whether such a drive is set to a value other than 0.   [main]
[[nodiscard]] bool is_running(const ToolSetup& setup);

}  // namespace kerf::run
