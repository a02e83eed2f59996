// SPDX-License-Identifier: Apache-2.0
#include "app/run_hand.h"

#include "app/interruption.h"
#include "app/shown_run.h"
#include "app/standard_streams.h"

namespace kerf::app {

ExitCode run_hand(const run::Scene& scene, const std::string& hand, const Environment& with, run::RunOutcome& outcome,
                  run::RunObserver* also) {
    run::RunRequest request;
    request.rehearsal = hand;
    const Interruption interruption;
    ShownRun shown_run(interruption);
    request.observers = {&shown_run};
    if (also != nullptr) request.observers.push_back(also);
    outcome = run::run_procedure(scene, with.plugins, request);
    if (outcome.was_interrupted) return complain("interrupted", exit_fault);
    if (!outcome.error.empty()) return complain(outcome.error, outcome.is_bad_input ? exit_bad_input : exit_fault);
    return exit_pass;
}

}  // namespace kerf::app
