// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "app/interruption.h"
#include "app/run_display.h"
#include "run/documents.h"
#include "run/run_procedure.h"
#include "run/scene.h"
#include "text/result.h"

namespace kerf::app {

/// Makes the scene on another thread, while the display shows the progress. The user may end it there.   [main]
/// @param file  name of the procedure, for the progress
[[nodiscard]] text::Result<run::Scene> make_bone_shown(run::Documents documents, const std::string& file,
                                                       RunDisplay& display);

/// Calls `run` with the request on another thread, while the display shows the run on this one. If the display cannot
/// draw, the run ends and the outcome has the error.   [main]
[[nodiscard]] run::RunOutcome run_shown(const run::Scene& scene, run::RunRequest request,
                                        const Interruption& interruption, RunDisplay& display,
                                        const std::function<run::RunOutcome(const run::RunRequest&)>& run);

}  // namespace kerf::app
