// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/haptics/scene/simulation.h"
#include "run/hand_inputs.h"
#include "run/loop_changes.h"
#include "run/next_actions.h"
#include "run/rehearsed_hand.h"
#include "run/run_procedure.h"
#include "run/session_files.h"
#include "run/signal_table.h"
#include "run/verdict/cut_results.h"
#include "run/verdict/held_bone.h"
#include "run/verdict/law_checks.h"
#include "session/content_hash.h"

namespace kerf::bone {
class ExactFollower;
}  // namespace kerf::bone

namespace kerf::run {

struct LoopLink;
struct LoopMessage;

/// A run, one tick at a time: call `create`, then `step` while it returns true, then `finish`. Or it follows a loop on
/// the clock: call `follow_loop` once, then `take` for each message of the loop.
///
/// Memory does not grow with the ticks: the record is in the session, and the page is made from it.   [main]
class Run {
public:
    /// Opens the record before any tool begins, so that even a failed run leaves a readable record. Returns null with
    /// the reason in `refusal`. Pre: scene and plugins outlive the run.
    static std::unique_ptr<Run> create(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request,
                                       RunOutcome& refusal);
    ~Run();
    Run(const Run&) = delete;
    Run& operator=(const Run&) = delete;

    /// Runs one tick with the simulated hand, or with the recorded one. Returns whether the run continues.
    bool step();
    /// Runs one tick with a device that reported this sample [world frame]; send it `last().command`. Ignores the
    /// rehearsal's path and the inputs at its waypoints. Missed ticks are recorded and replayed; `time` counts the
    /// ticks that ran.
    bool step(const DeviceSample& sample);
    /// Requests an input other than motion before the next tick: an undo, a clutch (`regrip`), an image, help. It is
    /// recorded and replayed. A refusal causes the event `hand.refused`. A run that follows a loop takes only passive
    /// ones; a replay takes none.
    void request(documents::HandInput input) { requested_.push_back(std::move(input)); }
    /// Returns the recorded run with which this one begins; null: it begins anew.
    [[nodiscard]] const RunBeginning* beginning() const noexcept { return request_.beginning.get(); }
    /// Returns the result of the last tick.
    [[nodiscard]] const TickResult& last() const noexcept { return result_; }
    [[nodiscard]] const Simulation& simulation() const noexcept { return simulation_; }
    /// Returns the present bone. An observer may take its changed bricks.
    [[nodiscard]] PresentBone& present() noexcept { return simulation_.present(); }
    [[nodiscard]] const StepMonitor& monitor() const noexcept { return monitor_; }
    /// Returns the next action of the running step in words; empty: it has none.
    [[nodiscard]] std::string next_action() const { return next_actions_.words(monitor_.current()); }
    /// Returns the exact surface made so far; null if no instrument leaves one.
    [[nodiscard]] bone::ExactFollower* exact() noexcept { return exact_.get(); }

    /// Returns a loop in the state of the run's own, to tick ahead of it. From now on the run only follows the messages
    /// of the link. Pre: no tick has run; `link` outlives the run.
    [[nodiscard]] std::unique_ptr<HapticLoop> follow_loop(LoopLink& link);
    /// Repeats what the loop has done. Returns whether the run continues.
    bool take(const LoopMessage& message);
    [[nodiscard]] const HandPlan& plan() const noexcept { return plan_; }
    [[nodiscard]] const documents::Rehearsal& rehearsal() const noexcept { return *rehearsal_; }

    /// Adds the figures of a clock to the summary.
    void set_clock(session::ClockRow clock) { outcome_.summary.clock = std::move(clock); }
    /// Judges the run and writes its results. Pre: called once.
    [[nodiscard]] RunOutcome finish();

private:
    /// An implant that its driver leaves in bone.
    struct LeftImplant {
        std::string instrument;
        const Body* body = nullptr;  ///< null: the implant is not drawn
        Pose world_from_body;
        std::size_t owner = 0;  ///< body with which it moves
    };
    Run(const Scene& scene, const RunRequest& request, const documents::Rehearsal& rehearsal,
        session::RunSummary summary, std::unique_ptr<SessionFiles> files);

    [[nodiscard]] bool is_replay() const noexcept { return !request_.replay.empty(); }
    void add_event_at(std::uint64_t tick, const std::string& id, const std::string& detail);
    /// Adds an event to the tick that just ran.
    void add_event(const std::string& id, const std::string& detail) {
        add_event_at(simulation_.ticks() - 1, id, detail);
    }
    void add_monitor_events();
    void pass_owners_on();
    void take_separations(std::uint64_t tick);
    void pass_cuts_on();
    void report_progress(double fraction, const std::string& what);
    void note_progress();
    void lead();
    [[nodiscard]] DeviceSample recorded_reading();
    void note_reading(const DeviceSample& reported);
    [[nodiscard]] bool tick(const DeviceSample& reported);
    [[nodiscard]] bool follow_tick(const LoopMessage& message);
    void follow_removal();
    void take_tool_of_step();
    void note_tool(std::size_t tool);
    void make_due_changes();
    void make_change(bool is_refused);
    void post_changes();
    void take_hand_inputs(const std::vector<documents::HandInput>& inputs);
    void take_rehearsed_inputs();
    void take_recorded_inputs();
    void take_passive_inputs();
    void take_passive(const documents::HandInput& input);
    [[nodiscard]] std::string help();
    void change(const documents::HandInput& input);
    void make_waiting_changes();
    void make_last_changes();
    void finish_input(const documents::HandInput& input);
    void observe(const Pose& handle, double now, bool has_tool);
    void end_step(std::size_t step, double now);
    void judge_step(std::size_t step, double now);
    [[nodiscard]] std::vector<documents::MeasureReading> measured_bone() const;
    [[nodiscard]] std::optional<LeftImplant> left_implant(std::size_t step);
    /// Compares the implants that were left with how they are at the end of the run.
    void judge_held_implants();
    [[nodiscard]] std::string insert(const LeftImplant& left);
    void note_left(const LeftImplant& left, const std::string& why_not);
    [[nodiscard]] std::optional<RunEnd> end_after_tick();
    void mark_missed_implants();
    void measure();
    void finish_exact_surface();

    std::unique_ptr<SessionFiles> files_;  ///< null: no files are written
    std::vector<RunObserver*> observers_;  ///< the files first, then the observers of the request
    const Scene* scene_;
    RunRequest request_;
    bool is_led_;  ///< a device leads the tool
    const documents::Rehearsal* rehearsal_;
    RunOutcome outcome_;
    SignalTable signals_;
    HandPlan plan_;
    RehearsedHand hand_;
    Simulation simulation_;
    LoopChanges changes_;
    std::vector<documents::HandInput> requested_;                          ///< since the last tick
    std::deque<std::variant<documents::HandInput, LeftImplant>> waiting_;  ///< changes that wait for an earlier one
    std::optional<documents::HandInput> changing_;                         ///< the input whose change is posted
    StepMonitor monitor_;
    LawChecks laws_;
    EarlierCut before_;
    session::ContentHash hash_;
    TickResult result_;
    session::TickRow row_;                                          ///< of the last tick
    std::size_t next_input_ = 0, next_missed_ = 0, next_lost_ = 0;  ///< indices into what was recorded
    NextActions next_actions_;
    std::size_t images_ = 0;                  ///< number of radiographs
    std::size_t helps_ = 0;                   ///< number of steps for which help was requested
    std::optional<std::size_t> helped_step_;  ///< the last of them
    bool has_begun_tick_ = false;             ///< a message of the loop came since the last one of a tick
    bool is_lost_ = false;                    ///< the device, in the last tick
    RunEnd end_ = RunEnd::time_over;
    std::vector<Pose> world_from_body_;
    double removed_ = 0.0, removed_before_step_ = 0.0;  ///< [m³]
    std::unique_ptr<bone::ExactFollower> exact_;
    std::vector<session::MetricRow> left_;  ///< of implants, when their drivers left them
    /// An implant with the bone around it when its driver left it.
    struct HeldImplant {
        std::size_t step = 0;
        HeldBone bone;
    };
    std::vector<HeldImplant> held_implants_;
    double back_ = 0.0;          ///< [m] by which the next tool is retracted: the driver leaves its implant
    std::size_t tool_ = 0;       ///< that the running step takes, or has taken
    bool is_tool_left_ = false;  ///< left with its implant: a step takes another tool
};

}  // namespace kerf::run
