// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace kerf {

/// The file that is meant: as it is named, or, where there is none of that name, the one of that name in the folder of
/// shipped procedures. A name of neither comes back as it is.   [main]
[[nodiscard]] std::string shipped_or_own(const std::string& name, const std::string& shipped_folder);

}  // namespace kerf
