// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace kerf {

/// Returns the reason why the dynamic linker must not load this file; empty if it may. Reads the headers alone: no code
/// of the file runs. A file that ends before its segments would crash the process in the linker, so the ends of the
/// segments are compared with the file's size.   [any]
[[nodiscard]] std::string refusal_of_file(const std::string& path);

}  // namespace kerf
