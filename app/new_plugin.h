// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace kerf {

/// Writes a plugin that builds and runs, the example 02_round_burr under another name, into a new folder.
/// @param name    a-z, 0-9 and _, beginning with a letter
/// @param folder  must not exist; empty: `name`
/// @return        what is wrong; empty on success   [main]
[[nodiscard]] std::string write_new_plugin(const std::string& name, const std::string& folder);

}  // namespace kerf
