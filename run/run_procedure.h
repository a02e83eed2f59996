// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/haptics/scene/simulation.h"
#include "documents/assist.h"
#include "run/hand_inputs.h"
#include "run/loop_changes.h"
#include "run/run_observer.h"
#include "run/run_result.h"

/// One run in lock-step: simulated hand, ticks, record and verdict.
namespace kerf::run {

class ExactStrategies;

struct RunBeginning;

struct RunRequest {
    std::string rehearsal;  ///< id; empty: the first
    std::string
        /// Folder for session.db, summary.json, report.html, bone.stl, bone-1.stl …; empty: no files are written.
        out;
    std::string learner, mode = "practice";
    /// Returns whether the run has no undo, and viewers hide what helps.
    [[nodiscard]] bool is_examination() const noexcept { return mode == "exam"; }
    std::optional<documents::Assist> assist{};  ///< none: that of the procedure
    /// Returns the help that viewers give; an examination has none.
    [[nodiscard]] documents::Assist assist_with(const documents::Procedure& procedure) const noexcept {
        return is_examination() ? documents::Assist::off : assist.value_or(procedure.assist);
    }
    std::vector<Pose> replay;              ///< device poses of a recorded run, which the hand repeats
    std::vector<std::uint64_t> adoptions;  ///< of that run: ticks after which the loop took over separated bodies
    RecordedInputs hand_inputs;            ///< of that run: other inputs, each with the tick before which it came
    std::vector<LateChange> late_changes;  ///< of that run: changes that its loop took over late, in order
    std::vector<std::pair<std::uint64_t, std::uint32_t>>
        missed;  ///< of that run: numbers of missed ticks, each with the next tick, in order
    std::vector<std::pair<std::uint64_t, bool>>
        lost;  ///< of that run: ticks at which its device was lost (true) or back, in order
    /// A recorded run that this one repeats up to a tick, to the same bits, and then continues by mouse; null: none.
    std::shared_ptr<const RunBeginning> beginning{};
    /// Name of the device that leads the tool; the rehearsal then only gives the start and the actions of its steps.
    /// Empty: the rehearsal's hand leads it.
    std::string leader, leader_setup;     ///< the latter as in RunSummary
    bool is_led_by_mouse = false;         ///< the leader is a mouse
    std::vector<RunObserver*> observers;  ///< they must outlive the run
    /// Properties of its parts for the session alone, as "example.peck badge": "never checked".
    std::vector<std::pair<std::string, std::string>> parts{};
    const ExactStrategies* strategies = nullptr;  ///< of the procedure's instruments, started; null: no exact surface
};

/// The first part of a recorded run.
struct RunBeginning {
    RunRequest run;           ///< its hand, inputs and late changes, as of a replay
    std::string parent;       ///< uuid of its session
    std::uint64_t ticks = 0;  ///< of this part; at most those of the run

    [[nodiscard]] double duration() const noexcept { return Simulation::dt * static_cast<double>(ticks); }  ///< [s]
};

struct RunOutcome {
    session::RunSummary summary;
    bool is_as_expected = false;
    std::vector<std::vector<std::size_t>> broken_limits;  ///< for each step: positions among its limits
    std::vector<std::string> over_budget;  ///< laws slower than their declared budget; differs from run to run
    bool was_interrupted = false;          ///< outputs are written nevertheless
    std::string error;                     ///< for people; not empty: the run could not be started or written
    bool is_bad_input = false;             ///< the error is a mistake in the user's input
};

/// Returns why a procedure does not have this rehearsal, with a suggestion; empty if it does. An empty `id` means the
/// first one.   [any] pure.
[[nodiscard]] std::string refusal_of_rehearsal(const documents::Procedure& procedure, const std::string& id);

/// Returns this rehearsal of a procedure. An empty `id` means the first one.   [any] pure.
/// Pre: the procedure has it.
[[nodiscard]] const documents::Rehearsal& rehearsal_of(const documents::Procedure& procedure, const std::string& id);

/// Runs a rehearsal of the scene's procedure. Memory does not grow with the ticks: the record is in the session, and
/// the page is made from it.   [main]
[[nodiscard]] RunOutcome run_procedure(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request);

}  // namespace kerf::run
