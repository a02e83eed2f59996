// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/commands.h"
#include "app/exit_code.h"
#include "run/documents.h"

namespace kerf::app {

/// Runs the first rehearsal that expects to pass on a modelled device, and prints what a hand feels there.   [main]
/// @param file    of the procedure, for messages
/// @param device  id of a model: "touch"
[[nodiscard]] ExitCode print_cues(const run::Documents& documents, const std::string& file, const std::string& device,
                                  const Environment& with);

}  // namespace kerf::app
