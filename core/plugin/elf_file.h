// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace kerf {

/// Why the dynamic linker must not be given this file; empty when it may. Reads only its headers: no code of it runs.
/// A file that ends before its segments would end the process in the linker, so their ends are compared with its size.
/// [any]
[[nodiscard]] std::string refusal_of_file(const std::string& path);

}  // namespace kerf
