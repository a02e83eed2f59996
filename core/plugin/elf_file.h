// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace kerf {

/// Returns the reason why the dynamic linker must not load this file; empty if it may. Reads the headers only, so no
/// code of the file runs. Compares the ends of the segments with the file's size: a file that is cut short would crash
/// the process in the linker.   [any]
[[nodiscard]] std::string refusal_of_file(const std::string& path);

}  // namespace kerf
