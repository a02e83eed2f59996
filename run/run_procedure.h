// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "run/hand_inputs.h"
#include "run/run_observer.h"
#include "run/run_result.h"

/// One run in lock-step: the simulated hand, the tick, the record, the verdict.
namespace kerf {

class ExactStrategies;

struct RunRequest {
    std::string rehearsal;  ///< id; empty: the first
    std::string
        out;  ///< folder for session.db, summary.json, report.html, bone.stl, bone-1.stl …; empty: nothing is written
    std::string learner, mode = "practice";
    std::vector<Pose> replay;  ///< device poses of a recorded run: the hand does what it did then
    std::vector<std::uint64_t>
        adoptions;                     ///< of that run: the ticks after which the loop took over what had come apart
    HandInputs::Recorded hand_inputs;  ///< of that run: what else was asked for, and before which tick
    std::vector<std::pair<std::uint64_t, std::uint32_t>>
        missed;                           ///< of that run: ticks that did not run, and before which one, in order
    std::vector<RunObserver*> observers;  ///< they must outlive the run
    const ExactStrategies* strategies = nullptr;  ///< of the procedure's instruments, running; null: no exact surface
};

struct RunOutcome {
    RunSummary summary;
    bool is_as_expected = false;
    std::vector<std::string> over_budget;  ///< laws that were slower than they declare; differs from run to run
    bool was_interrupted = false;          ///< outputs are written all the same
    std::string error;                     ///< for people; not empty: the run could not be made or written
    bool is_bad_input = false;             ///< the error is the user's input
};

/// Why a procedure has no such rehearsal, empty: the first, with what to write; empty if it has.   [any] pure.
[[nodiscard]] std::string refusal_of_rehearsal(const Procedure& procedure, const std::string& id);

/// Runs a rehearsal of the scene's procedure. Memory does not grow with its ticks: the record goes to the session, and
/// the page is made from that.   [main]
[[nodiscard]] RunOutcome run_procedure(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request);

}  // namespace kerf
