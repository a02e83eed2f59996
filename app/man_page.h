// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace kerf::app {

/// Returns the manual page kerf(1) as roff with the `man` macros, in ASCII, from the table of commands.   [any]
[[nodiscard]] std::string man_page();

}  // namespace kerf::app
