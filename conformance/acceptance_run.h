// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "conformance/acceptance_file.h"

namespace kerf::conformance {

/// Leads a law's tool along the file's script and fills in the wrenches, in a child process. Returns what went wrong;
/// empty if nothing did. `file.subject` becomes the law that was run.   [main] Pre: one thread
[[nodiscard]] std::string run_script(const std::string& plugin, AcceptanceFile& file);

}  // namespace kerf::conformance
