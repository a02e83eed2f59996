// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "app/exit_code.h"
#include "app/interruption.h"
#include "app/run_display.h"
#include "run/documents.h"
#include "run/run_procedure.h"
#include "run/scene.h"
#include "text/result.h"

namespace kerf::app {

/// Calls `work` on another thread, while the display shows `what`. If the user ends it there, `interruption` comes.
/// [main]
[[nodiscard]] ExitCode wait_shown(const std::string& what, RunDisplay& display, const Interruption& interruption,
                                  const std::function<ExitCode()>& work);

/// Makes the scene on another thread, while the display shows the progress. The user may end it there.   [main]
/// @param file  name of the procedure, for the progress
[[nodiscard]] text::Result<run::Scene> make_bone_shown(run::Documents documents, const std::string& file,
                                                       RunDisplay& display);

/// Calls `run` with the request on another thread, while the display shows the run on this one. If the display cannot
/// draw, the run ends and the outcome has the error.   [main]
/// @param mouse  gets what the user does with the mouse; null: a rehearsal or a device leads the tool
[[nodiscard]] run::RunOutcome run_shown(const run::Scene& scene, run::RunRequest request, run::MouseBox* mouse,
                                        const Interruption& interruption, RunDisplay& display,
                                        const std::function<run::RunOutcome(const run::RunRequest&)>& run);

}  // namespace kerf::app
