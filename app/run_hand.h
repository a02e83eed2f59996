// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/commands.h"
#include "run/run_procedure.h"
#include "run/scene.h"

namespace kerf::app {

/// Runs a hand of the scene's procedure, and shows the progress. Prints why it could not, and returns that code;
/// `exit_pass` if it ran.   [main]
/// @param also   a further observer; may be null
[[nodiscard]] ExitCode run_hand(const run::Scene& scene, const std::string& hand, const Environment& with,
                                run::RunOutcome& outcome, run::RunObserver* also = nullptr);

}  // namespace kerf::app
