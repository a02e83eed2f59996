// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/haptics/scene/simulation.h"
#include "devices/simulated_hand/simulated_hand.h"
#include "run/button_presses.h"
#include "run/clock/tick_trace.h"
#include "run/hand_inputs.h"
#include "run/next_actions.h"
#include "run/run_procedure.h"
#include "run/session_files.h"
#include "run/signal_table.h"
#include "run/verdict/cut_results.h"
#include "session/content_hash.h"

namespace kerf::bone {
class ExactFollower;
}  // namespace kerf::bone

namespace kerf::run {

/// Takes the force of each tick.
class ForceSink {
public:
    virtual ~ForceSink() = default;
    /// [haptic, nonblocking]
    virtual void write(const TickResult& result, std::uint64_t tick) noexcept = 0;
};

/// A run in lock-step, one tick at a time: call `create`, then `step` while it returns true, then `finish`.
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
    bool step() { return step_after(0); }
    /// Runs one tick of a rehearsal on a clock that has missed this number of periods since the last tick. The
    /// simulated hand moves on during them, under the last command. Pre: not a replay.
    bool step_after(std::uint32_t missed);
    /// Takes the tool of the step and carries out requests before the next tick with a device. Both may take longer
    /// than a tick, so call it before the clock waits and the device is read.
    /// @param presses  of the device's buttons
    void prepare(const ButtonPresses& presses);
    /// Runs one tick with a device that reported this sample [world frame]; send it `last().command`. Ignores the
    /// rehearsal's path and the inputs at its waypoints. Missed ticks are recorded and replayed; `time` counts the
    /// ticks that ran.
    bool step(const DeviceSample& sample);
    /// Sends the force of each tick to a sink as soon as it is known, before the tick is recorded. Pre: it outlives the
    /// run.
    void send_to(ForceSink& sink) noexcept { sink_ = &sink; }
    /// Requests an input other than motion before the next tick with a device: an undo, a clutch (`regrip`). It is
    /// recorded and replayed. A refusal causes the event `hand.refused`.
    void request(documents::HandInput input) { requested_.push_back(std::move(input)); }
    /// Returns the result of the last tick.
    [[nodiscard]] const TickResult& last() const noexcept { return result_; }
    [[nodiscard]] const Simulation& simulation() const noexcept { return simulation_; }
    [[nodiscard]] const StepMonitor& monitor() const noexcept { return monitor_; }
    /// Returns the exact surface made so far; null if no instrument leaves one.
    [[nodiscard]] bone::ExactFollower* exact() noexcept { return exact_.get(); }

    /// Prepares ticks on a clock: measures the parts of each tick, and leaves progress to `pass_progress_on`. Pre: no
    /// tick has run, `parts` outlives the run.
    void begin_clock(TickParts& parts) { parts_ = &parts; }
    /// Passes the progress of a run on a clock on to its observers.   [any] also while another thread ticks
    void pass_progress_on();
    /// Adds the figures of a clock to the summary.
    void set_clock(session::ClockRow clock) { outcome_.summary.clock = std::move(clock); }
    /// Judges the run and writes its results. Pre: called once.
    [[nodiscard]] RunOutcome finish();

private:
    Run(const Scene& scene, const RunRequest& request, const documents::Rehearsal& rehearsal,
        session::RunSummary summary, std::unique_ptr<SessionFiles> files);

    [[nodiscard]] bool is_replay() const noexcept { return !request_.replay.empty(); }
    void add_event_at(std::uint64_t tick, const std::string& id, const std::string& detail);
    /// Adds an event to the tick that just ran.
    void add_event(const std::string& id, const std::string& detail) {
        add_event_at(simulation_.ticks() - 1, id, detail);
    }
    void end_of(TickPart part) noexcept {
        if (parts_ != nullptr) parts_->end_of(part);
    }
    void add_monitor_events();
    void pass_owners_on();
    void take_separations(std::uint64_t tick);
    void pass_cuts_on();
    void report_progress(double fraction, const std::string& what);
    void note_progress();
    void lead();
    [[nodiscard]] DeviceSample recorded_reading();
    void note_force();
    void take_presses(const ButtonPresses& presses);
    void note_reading(const DeviceSample& reported);
    [[nodiscard]] simulated_hand::SensedTool sensed_tool() const;
    [[nodiscard]] bool tick(const DeviceSample& reported);
    void move_hand(std::uint32_t periods);
    void take_tool_of_step();
    void take_hand_inputs(const std::vector<documents::HandInput>& inputs);
    void observe(const Pose& handle, double now);
    void judge_step(std::size_t step, double now);
    [[nodiscard]] std::vector<documents::MeasureReading> measured_bone() const;
    void leave_implant(std::size_t step);
    [[nodiscard]] std::optional<RunEnd> end_after_tick();
    void mark_missed_implants();
    void measure();
    void finish_exact_surface();

    std::unique_ptr<SessionFiles> files_;  ///< null: no files are written
    std::vector<RunObserver*> observers_;  ///< the files first, then the observers of the request
    const Scene* scene_;
    RunRequest request_;
    const documents::Rehearsal* rehearsal_;
    RunOutcome outcome_;
    SignalTable signals_;
    HandPlan plan_;
    simulated_hand::SimulatedHand hand_;
    Simulation simulation_;
    HandInputs hand_inputs_;
    std::vector<documents::HandInput> requested_;  ///< since the last tick
    StepMonitor monitor_;
    EarlierCut before_;
    session::ContentHash hash_;
    TickResult result_;
    session::TickRow row_;                         ///< of the last tick
    std::size_t next_missed_ = 0, next_lost_ = 0;  ///< indices into the recorded missed ticks and losses
    NextActions next_actions_;
    ForceSink* sink_ = nullptr;
    bool is_driving_ = true;      ///< the drives of the tool in hand are as configured; false: they are off
    bool is_lost_ = false;        ///< the device, in the last tick
    double force_before_ = 0.0;   ///< [N] of the device on the simulated hand, before it was lost
    bool is_force_away_ = false;  ///< after a fault, until it is fully back
    bool has_slipped_ = false;    ///< the tool was anchored anew in the simulated hand
    RunEnd end_ = RunEnd::time_over;
    std::vector<Pose> world_from_body_;
    double removed_ = 0.0, removed_before_step_ = 0.0;  ///< [m³]
    std::unique_ptr<bone::ExactFollower> exact_;
    std::vector<session::MetricRow> left_;  ///< of implants, when their drivers left them
    double back_ = 0.0;                     ///< [m] by which the next tool is retracted: the driver leaves its implant
    TickParts* parts_ = nullptr;            ///< of the clock; null in lock-step
    std::atomic<std::uint64_t> ticks_done_{0};
    std::atomic<std::size_t> step_{0};    ///< for the progress
    std::atomic<double> path_done_{0.0};  ///< [–] fraction of the hand's path, or of the recorded ticks
    bool is_tool_left_ = false;           ///< left with its implant: a step takes another tool
};

}  // namespace kerf::run
