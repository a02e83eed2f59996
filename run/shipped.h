// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace kerf::run {

/// Returns the file `name` if it exists, else the file of that name in the folder of shipped procedures. Returns `name`
/// if neither exists.   [main]
[[nodiscard]] std::string shipped_or_own(const std::string& name, const std::string& shipped_folder);

}  // namespace kerf::run
