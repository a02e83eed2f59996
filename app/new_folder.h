// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace kerf::app {

/// Writes an example under another name into a new folder, as a plugin that builds and runs.
/// @param name    a-z, 0-9 and _, beginning with a letter
/// @param folder  must not exist; empty: `name`
/// @param is_strategy  the example 06_groove, a remeshing strategy; else 02_round_burr, a tool with its law
/// @return        an error message; empty on success   [main]
[[nodiscard]] std::string write_new_plugin(const std::string& name, const std::string& folder,
                                           bool is_strategy = false);

}  // namespace kerf::app
