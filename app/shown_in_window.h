// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <string>
#include <type_traits>

#include "app/exit_code.h"
#include "app/interruption.h"
#include "app/run_display.h"
#include "run/documents.h"
#include "run/run_procedure.h"
#include "run/scene.h"
#include "run/view/run_view.h"
#include "text/result.h"

namespace kerf::app {

/// Calls `work` on another thread, while the display shows `what`. If the user ends it there, `interruption` comes.
/// [main]
[[nodiscard]] ExitCode wait_shown(const std::string& what, RunDisplay& display, const Interruption& interruption,
                                  const std::function<ExitCode()>& work);

/// Calls `work` on another thread and returns its result, while the display shows `what`.   [main]
/// @param fraction   of the work that is done, 0 … 1 [–]
/// @param meanwhile  called again and again until then
template <class Work, class Fraction, class Meanwhile>
[[nodiscard]] std::invoke_result_t<Work> done_behind(RunDisplay& display, const std::string& what,
                                                     const Fraction& fraction, const Work& work,
                                                     const Meanwhile& meanwhile) {
    auto running = std::async(std::launch::async, work);
    display.wait(what, fraction, [&] {
        meanwhile();
        return running.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
    });
    return running.get();
}

/// Makes the scene on another thread, while the display shows the progress. The user may end it there.   [main]
/// @param file  name of the procedure, for the progress
[[nodiscard]] text::Result<run::Scene> make_bone_shown(run::Documents documents, const std::string& file,
                                                       RunDisplay& display);

/// Calls `run` on another thread, while the display shows it by its view on this one. The display closes if the run
/// fails or is interrupted; the run ends when the display has closed. If the display cannot draw, the outcome has the
/// error.   [main]
[[nodiscard]] run::RunOutcome run_behind(RunDisplay& display, run::RunView& view, const Interruption& interruption,
                                         const std::function<run::RunOutcome()>& run);

/// Calls `run` with the request on another thread, while the display shows the run on this one. If the display cannot
/// draw, the run ends and the outcome has the error.   [main]
/// @param language  of the procedure's words, as "de"
/// @param mouse  gets what the user does with the mouse; null: a rehearsal or a device leads the tool
[[nodiscard]] run::RunOutcome run_shown(const run::Scene& scene, run::RunRequest request, const std::string& language,
                                        run::MouseBox* mouse, const Interruption& interruption, RunDisplay& display,
                                        const std::function<run::RunOutcome(const run::RunRequest&)>& run);

}  // namespace kerf::app
