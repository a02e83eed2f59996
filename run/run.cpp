// SPDX-License-Identifier: Apache-2.0
#include "run/run.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "bone/exact/exact_follower.h"
#include "core/field/cut/removed_volume.h"
#include "run/body_ownership.h"
#include "run/exact/exact_files.h"
#include "run/exact/exact_strategies.h"
#include "run/plate_steps.h"
#include "run/tick_row.h"
#include "run/verdict/measure_bone.h"
#include "run/verdict/run_metrics.h"
#include "text/quantity.h"

namespace kerf::run {

namespace {

constexpr std::uint32_t max_moved_periods = 1000;  // of a pause; in a longer one the hand waits
constexpr double noticed_force = 0.1;              // [N] on the hand: a hand notices when it fades [assumed]
constexpr int volume_interval = 50;                // ticks between counts of the removed volume
constexpr double crumb = 10e-9;                    // [m³] smaller pieces do not become bodies: they are washed away

/// Removes −0, which SQLite does not store, so that a replay starts with the same bits.
Pose without_negative_zeros(const Pose& p) {
    return {{p.position.x + 0.0, p.position.y + 0.0, p.position.z + 0.0},
            {p.rotation.w + 0.0, p.rotation.x + 0.0, p.rotation.y + 0.0, p.rotation.z + 0.0}};
}

std::string text_of(const Separation& separation) {
    const auto volume = [](double v) { return text::quantity_text(std::round(v * 1e9) * 1e-9, "mm3"); };
    std::string text;
    if (separation.parts.size() > 1)
        for (const auto& part : separation.parts)
            text += (text.empty() ? "body " : ", body ") + std::to_string(part.body) + ": " + volume(part.volume);
    if (separation.crumbs == 0) return text;
    return text + (text.empty() ? "" : "; ") + std::to_string(separation.crumbs) +
           (separation.crumbs == 1 ? " crumb, " : " crumbs, ") + volume(separation.crumb_volume);
}

/// Returns whether bone resists the tool. A thread that pulls itself in has no positive thrust.
bool is_resisted(const TickResult& result, const Tool& tool) {
    return (result.thrust > 0.0 || (tool.outline.has_thread() && result.is_cutting)) && !result.is_at_metal;
}

std::string surface_file(std::size_t body, bool is_metal) {
    return body == 0 ? "bone.stl" : (is_metal ? "implant-" : "bone-") + std::to_string(body) + ".stl";
}

/// Returns the force of the bone on the tool across its shaft [N].
double lateral_force(const TickResult& result) {
    const Vec3 force = linear(result.bone_on_tool), shaft = rotate(result.world_from_tool.rotation, {0, 0, 1});
    return length(force - dot(force, shaft) * shaft);
}

/// Returns the part of the summary that is known before the first tick.
session::RunSummary summary_of(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request,
                               const documents::Rehearsal& rehearsal, const SignalTable& signals) {
    session::RunSummary summary;
    summary.procedure = scene.procedure.id;
    summary.procedure_version = scene.procedure.version;
    summary.variant = scene.procedure.variant;
    summary.anatomy = scene.anatomy.id;
    summary.rehearsal = rehearsal.id;
    summary.hand = !request.replay.empty() ? "replay" : request.is_led ? "device" : "simulated";
    summary.device = scene.device->id;
    summary.force_scale = scene.gains.force_scale;
    summary.coupling_stiffness = scene.procedure.is_direct ? 0.0 : scene.gains.stiffness;
    summary.versions.emplace_back("kerf", KERF_VERSION);
    for (const auto& plugin : plugins.plugins())
        summary.versions.emplace_back(plugin->entry().plugin_id, plugin->entry().plugin_version);
    for (const auto& material : scene.body.materials) summary.tissues.push_back(material.id);
    summary.signals = signals.columns;
    summary.anatomy_notes = scene.import.notes;
    return summary;
}

}  // namespace

// ---- before the first tick ----------------------------------------------------------------------------------------

std::unique_ptr<Run> Run::create(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request,
                                 RunOutcome& refusal) {
    if (refusal.error = refusal_of_rehearsal(scene.procedure, request.rehearsal); !refusal.error.empty()) {
        refusal.is_bad_input = true;
        return nullptr;
    }
    const auto rehearsal = std::find_if(
        scene.procedure.rehearsals.begin(), scene.procedure.rehearsals.end(),
        [&](const documents::Rehearsal& r) { return request.rehearsal.empty() || r.id == request.rehearsal; });
    session::RunSummary summary = summary_of(scene, plugins, request, *rehearsal, SignalTable(scene.tools));
    std::unique_ptr<SessionFiles> files;
    if (!request.out.empty()) {
        files = SessionFiles::create(scene, request, summary, refusal);
        if (files == nullptr) return nullptr;
    }
    return std::unique_ptr<Run>(new Run(scene, request, *rehearsal, std::move(summary), std::move(files)));
}

Run::Run(const Scene& scene, const RunRequest& request, const documents::Rehearsal& rehearsal,
         session::RunSummary summary, std::unique_ptr<SessionFiles> files)
    : files_(std::move(files)),
      observers_(request.observers),
      scene_(&scene),
      request_(request),
      rehearsal_(&rehearsal),
      signals_(scene.tools),
      plan_(plan_of(rehearsal, scene)),
      hand_(plan_.plant, plan_.intent, plan_.start, Simulation::dt),
      simulation_(scene.body, scene.tools, scene.gains, plan_.start),
      hand_inputs_(plan_, request_.replay.empty() ? nullptr : &request_.hand_inputs),
      monitor_(scene.procedure, scene.anatomy, scene.frames),
      next_actions_(rehearsal),
      world_from_body_(1, identity_pose()) {
    if (files_ != nullptr) observers_.insert(observers_.begin(), files_.get());
    outcome_.summary = std::move(summary);
    simulation_.find_pieces(crumb, body_ownership_of(*scene_));
    if (scene_->fragment) simulation_.begin_with(*scene_->fragment, scene_->world_from_fragment);
    pass_owners_on();
    for (std::size_t step = 0; step < scene_->procedure.steps.size(); ++step)
        if (scene_->tool(step).outline.is_implant()) monitor_.ends_with_release(step);
    if (is_replay()) simulation_.replay_adoptions(request_.adoptions);
    before_.begin(simulation_.present());
    if (request_.strategies != nullptr && request_.strategies->are_any())
        exact_ = std::make_unique<bone::ExactFollower>(request_.strategies->tools(*scene_));
    lead();
}

Run::~Run() = default;

// ---- a tick -------------------------------------------------------------------------------------------------------

bool Run::step_after(std::uint32_t missed) {
    if (missed > 0) move_hand(missed);
    end_of(TickPart::hand);
    take_tool_of_step();
    end_of(TickPart::tool);
    take_hand_inputs(hand_inputs_.take(simulation_.ticks(), hand_.leg(), hand_.is_regripping()));
    end_of(TickPart::inputs);
    return tick(is_replay() ? recorded_reading() : DeviceSample{hand_.reported(), missed});
}

/// Lets the simulated hand move during missed periods, under the last command.
void Run::move_hand(std::uint32_t periods) {
    simulated_hand::SensedTool sensed = sensed_tool();
    sensed.has_event = false;  // the hand felt the event when the last tick ended
    for (std::uint32_t i = 0; i < std::min(periods, max_moved_periods); ++i) hand_.step(result_.command, sensed);
}

void Run::prepare(const ButtonPresses& presses) {
    take_tool_of_step();
    end_of(TickPart::tool);
    take_presses(presses);
    take_hand_inputs(std::exchange(requested_, {}));
    end_of(TickPart::inputs);
}

bool Run::step(const DeviceSample& sample) {
    if (!request_.is_led) request_.is_led = true;  // another thread may read it
    take_tool_of_step();
    end_of(TickPart::tool);
    take_hand_inputs(std::exchange(requested_, {}));
    end_of(TickPart::inputs);
    return tick(sample);
}

/// Requests what the buttons of a device request.
void Run::take_presses(const ButtonPresses& presses) {
    using documents::HandInput;
    if (std::exchange(is_driving_, presses.is_driving) != presses.is_driving) {
        const ToolSetup& setup = simulation_.setup();
        for (std::uint32_t i = 0; i < setup.tool->tool->drive_count; ++i)
            if (const double value = setup.drives[i]; value != 0.0)
                request({HandInput::Kind::drive, setup.tool->tool->drives[i].id, presses.is_driving ? value : 0.0});
    }
    if (presses.wants_undo) request({HandInput::Kind::undo});
    if (!presses.wants_next) return;
    const auto action = next_actions_.take(monitor_.current());
    requested_.insert(requested_.end(), action.begin(), action.end());
}

/// Records the inputs of the tick that just ran, other than its pose: missed periods, and a device lost or back.
void Run::note_reading(const DeviceSample& reported) {
    if (reported.missed > 0) {
        add_event(session::missed_event, std::to_string(reported.missed));
        hash_.add(reported.missed);
    }
    if (reported.is_lost == std::exchange(is_lost_, reported.is_lost)) return;
    add_event(reported.is_lost ? session::lost_event : session::back_event, "");
    hash_.add(std::uint32_t{reported.is_lost});
}

DeviceSample Run::recorded_reading() {
    DeviceSample sample{request_.replay[simulation_.ticks()]};
    const auto& missed = request_.missed;
    for (; next_missed_ < missed.size() && missed[next_missed_].first <= simulation_.ticks(); ++next_missed_)
        sample.missed = missed[next_missed_].second;
    sample.is_lost = is_lost_;
    for (const auto& lost = request_.lost; next_lost_ < lost.size() && lost[next_lost_].first <= simulation_.ticks();)
        sample.is_lost = lost[next_lost_++].second;
    return sample;
}

bool Run::tick(const DeviceSample& reported) {
    const Pose handle = without_negative_zeros(reported.world_from_handle);
    const DeviceSample sample{handle, reported.missed, reported.is_lost};
    result_ = scene_->procedure.is_direct ? simulation_.tick_direct(sample) : simulation_.tick(sample);
    if (sink_ != nullptr) sink_->write(result_, simulation_.ticks());
    note_reading(reported);
    end_of(TickPart::motion);
    if (!is_replay() && !request_.is_led) {
        note_force();
        hand_.step(result_.command, sensed_tool());
    }

    end_of(TickPart::hand);

    if (simulation_.ticks() % volume_interval == 0) removed_ = simulation_.present().removed();
    take_separations(simulation_.ticks() - 1);
    end_of(TickPart::bodies);
    if (exact_ != nullptr) exact_->follow(simulation_);
    end_of(TickPart::surface);
    const double now = static_cast<double>(simulation_.ticks() - 1) * Simulation::dt;
    const std::size_t step = monitor_.current();
    observe(handle, now);
    end_of(TickPart::monitor);
    if (monitor_.current() != step) judge_step(step, now);
    if (monitor_.needs_measures()) monitor_.show_measures(measured_bone());
    end_of(TickPart::step);
    for (std::size_t i = 0; i < result_.event_count; ++i) {
        add_event(result_.events[i], event_detail(result_.events[i], simulation_));
        monitor_.report(result_.events[i], now);
        add_monitor_events();
    }
    end_of(TickPart::events);
    const auto end = end_after_tick();
    end_of(TickPart::record);
    if (end) end_ = *end;
    return !end && simulation_.ticks() < static_cast<std::uint64_t>(scene_->procedure.time_limit / Simulation::dt);
}

/// Follows the force of the device before, in and after a fault, and gives the simulated hand the tool as it then lies
/// in the hand.
void Run::note_force() {
    has_slipped_ |= result_.has_event(TickResult::anchored_again);
    const bool was_away = std::exchange(is_force_away_, result_.is_closed_or_closing || result_.is_coming_back);
    if (is_force_away_) return;
    force_before_ = length(linear(result_.command.wrench));
    if (was_away || (has_slipped_ && simulation_.is_realigning())) hand_.regrasp(inverse(simulation_.grasp()));
}

/// Returns the tool state that the simulated hand senses after the last tick.
simulated_hand::SensedTool Run::sensed_tool() const {
    const std::string& awaited = hand_.awaited_event();
    return {.world_from_tool = result_.world_from_tool,
            .torque = result_.torque,
            .is_force_lost = is_force_away_ && force_before_ > noticed_force,
            .has_event = !awaited.empty() && result_.has_event(awaited)};
}

void Run::take_tool_of_step() {
    const std::size_t tool = scene_->tool_of_step[monitor_.current()];
    if (tool == simulation_.tool() && !is_tool_left_) return;
    is_tool_left_ = false;
    is_driving_ = true;  // a tool begins with its configured drives
    simulation_.take_another(tool, std::exchange(back_, 0.0));
    pass_cuts_on();
    take_separations(simulation_.ticks());
    add_event_at(simulation_.ticks(), "tool.taken", scene_->procedure.steps[monitor_.current()].instrument);
}

void Run::take_hand_inputs(const std::vector<documents::HandInput>& inputs) {
    for (const documents::HandInput& input : inputs) {
        add_event_at(simulation_.ticks(), session::hand_input_event, text_of(input));
        std::string why_not = carry_out(input, *scene_, simulation_);
        if (why_not.empty() && input.kind == documents::HandInput::Kind::release) why_not = monitor_.release();
        if (!why_not.empty()) {
            add_event_at(simulation_.ticks(), "hand.refused", text_of(input) + ": " + why_not);
        } else if (input.kind != documents::HandInput::Kind::drive &&
                   input.kind != documents::HandInput::Kind::regrip) {
            if (input.kind == documents::HandInput::Kind::undo || input.kind == documents::HandInput::Kind::redo ||
                input.kind == documents::HandInput::Kind::subtract)
                pass_cuts_on();
            if (input.kind == documents::HandInput::Kind::undo || input.kind == documents::HandInput::Kind::redo)
                pass_owners_on();
            if (!scene_->holes.empty()) {
                follow_plates(*scene_, simulation_, monitor_);
                lead();
            }
            before_.follow(simulation_.present());
        }
    }
}

void Run::observe(const Pose& handle, double now) {
    world_from_body_.clear();
    for (const auto& body : simulation_.bodies()) world_from_body_.push_back(body->world_from_body);
    const Vec3 tip = result_.world_from_tool.position;
    const std::int32_t tissue = tissue_at(*scene_, simulation_, tip);
    monitor_.observe({.time = now,
                      .world_from_tool = result_.world_from_tool,
                      .is_running = result_.is_cutting,
                      .is_resisted = is_resisted(result_, scene_->tools[simulation_.tool()]),
                      .thrust = result_.thrust,
                      .world_from_body = world_from_body_,
                      .held = simulation_.held(),
                      .is_bone_ahead = tissue >= 0,
                      .tip_inside = tip_inside(simulation_, monitor_, tip),
                      .handle = handle.position,
                      .torque = result_.torque,
                      .lateral_force = lateral_force(result_),
                      .removed = removed_ - removed_before_step_,
                      .signals = {simulation_.signals(), simulation_.setup().force->force->signal_count}},
                     simulation_.outline().cutting);
    row_ = row_of(result_, *scene_, simulation_, monitor_, signals_, handle, tissue, removed_);
    session::add_tick(hash_, row_);
    add_monitor_events();
}

/// Measures and judges the step that ended in this tick.
void Run::judge_step(std::size_t step, double now) {
    removed_ = simulation_.present().removed();
    monitor_.judge_cut(step, wall_of(*scene_, simulation_, before_, monitor_, step), removed_ - removed_before_step_,
                       now);
    add_monitor_events();
    if (auto hole = scene_->tool(step).outline.is_implant() ? screw_of(*scene_, simulation_, monitor_, step)
                                                            : hole_of(*scene_, simulation_, before_, monitor_, step)) {
        monitor_.judge_hole(step, std::move(*hole), now);
        add_monitor_events();
    }
    if (!scene_->procedure.measures.empty()) {
        std::vector<documents::MeasureReading> measures = measured_bone();
        for (std::size_t m = 0; m < measures.size(); ++m)
            if (!measures[m].value)
                add_event("measure.failed", scene_->procedure.measures[m].id + ": " + measures[m].why_not);
        monitor_.judge_measures(step, std::move(measures), now);
        add_monitor_events();
    }
    leave_implant(step);
    removed_before_step_ = removed_;
    before_.begin(simulation_.present());
    if (monitor_.current() < scene_->procedure.steps.size()) lead();
}

std::vector<documents::MeasureReading> Run::measured_bone() const {
    return measure_bone(*scene_, simulation_.present(), world_from_body_);
}

/// Leaves an implant in bone; its driver leaves it.
void Run::leave_implant(std::size_t step) {
    const std::size_t tool = scene_->tool_of_step[step];
    if (!scene_->tools[tool].outline.is_implant()) return;
    is_tool_left_ = true;
    constexpr double clear = 5e-3;  // [m] distance from the bone
    back_ = std::max(0.0, monitor_.frame(step).depth_of(simulation_.world_from_tool().position)) + clear;
    for (session::MetricRow& row : implant_metrics(scene_->procedure.steps[step].id,
                                                   *scene_->tools[tool].setup.force->force, simulation_.signals()))
        left_.push_back(std::move(row));
    const std::string& instrument = scene_->procedure.steps[step].instrument;
    const std::optional<Body>& implant = scene_->staying[tool];
    const std::string why_not =
        implant ? simulation_.insert(*implant, simulation_.world_from_tool(), false, monitor_.owners().step[step]) : "";
    add_event("tool.left", why_not.empty() ? instrument : instrument + ", unseen: " + why_not);
}

std::optional<RunEnd> Run::end_after_tick() {
    for (RunObserver* observer : observers_) observer->on_tick(row_);
    pass_cuts_on();
    const std::uint64_t ticks = simulation_.ticks();
    if (ticks % 250 == 0) note_progress();
    // The force has faded.
    if (result_.is_quarantined && linear(result_.command.wrench) == Vec3{}) return RunEnd::fault;
    if (monitor_.current() >= scene_->procedure.steps.size()) return RunEnd::steps_done;
    for (RunObserver* observer : observers_)
        if (const auto end = observer->end()) {
            outcome_.was_interrupted = *end == RunEnd::interrupted;
            return end;
        }
    if (request_.is_led) return std::nullopt;
    if (is_replay() ? ticks >= request_.replay.size() : hand_.is_done() && !hand_inputs_.is_due(hand_.leg()))
        return RunEnd::path_ended;
    return std::nullopt;
}

// ---- events, bodies, cuts -----------------------------------------------------------------------------------------

void Run::add_event_at(std::uint64_t tick, const std::string& id, const std::string& detail) {
    session::EventRow event;
    event.tick = tick;
    event.time = static_cast<double>(event.tick) * Simulation::dt;
    event.id = id;
    event.detail = detail;
    session::add_event(hash_, event);
    const session::EventRow kept = session::Recorder::as_kept(std::move(event));
    for (RunObserver* observer : observers_) observer->on_event(kept);
}

void Run::add_monitor_events() {
    for (const auto& [id, detail] : monitor_.new_events()) add_event(id, detail);
}

/// Passes on the owners after an undo, redo or separation has changed the bodies.
void Run::pass_owners_on() { monitor_.set_owners(simulation_.owners()); }

/// Records separations. The tick is the one after which the loop took over the parts.
void Run::take_separations(std::uint64_t tick) {
    for (const Separation& separation : simulation_.take_separations()) {
        add_event_at(tick, separation.parts.size() > 1 ? session::came_apart_event : session::crumbled_event,
                     text_of(separation));
        before_.follow(simulation_.present());
        pass_owners_on();
    }
}

void Run::pass_cuts_on() {
    for (const CutRecord& record : simulation_.closed())
        for (RunObserver* observer : observers_) observer->on_cut(record);
}

void Run::report_progress(double fraction, const std::string& what) {
    for (RunObserver* observer : observers_) observer->on_progress(fraction, what);
}

void Run::note_progress() {
    const std::uint64_t ticks = simulation_.ticks();
    const auto fraction = [](std::size_t done, std::size_t all) {
        return static_cast<double>(done) / static_cast<double>(all);
    };
    step_ = monitor_.current();
    path_done_ = is_replay()       ? fraction(ticks, request_.replay.size())
                 : request_.is_led ? fraction(step_, scene_->procedure.steps.size())
                                   : fraction(hand_.leg(), plan_.intent.legs.size());
    ticks_done_ = ticks;
    if (parts_ == nullptr) pass_progress_on();
}

void Run::pass_progress_on() {
    std::string what = "working, " + std::to_string(ticks_done_ / 1000) + " s simulated";
    if (const std::size_t step = step_; request_.is_led && step < scene_->procedure.steps.size()) {
        what = std::to_string(ticks_done_ / 1000) + " s, step `" + scene_->procedure.steps[step].id + "`";
        if (const std::string next = next_actions_.words(step); !next.empty()) what += "; the button next: " + next;
    }
    report_progress(path_done_, what);
}

/// Sets the sleeve of the running step, on the body that owns its axis.
void Run::lead() { simulation_.lead(guide_of_step(*scene_, monitor_)); }

// ---- after the last tick ------------------------------------------------------------------------------------------

RunOutcome Run::finish() {
    simulation_.finish();
    pass_cuts_on();
    // A tick that never runs: at its end, a replay also takes over the remaining parts.
    take_separations(simulation_.ticks());
    hash_.add(simulation_.present().hash());
    measure();
    if (exact_ != nullptr)
        finish_exact_surface();
    else if (request_.strategies != nullptr && !request_.strategies->why_not().empty())
        outcome_.summary.exact.emplace().why_not = request_.strategies->why_not();
    if (files_ != nullptr) report_progress(1.0, "writing the results");
    for (RunObserver* observer : observers_) {
        const std::string error = observer->on_result(outcome_.summary, simulation_);
        if (!error.empty()) outcome_.error += (outcome_.error.empty() ? "" : "\n      ") + error;
    }
    return std::move(outcome_);
}

void Run::finish_exact_surface() {
    const auto is_interrupted = [this] {
        return std::any_of(observers_.begin(), observers_.end(),
                           [](RunObserver* observer) { return observer->end() == RunEnd::interrupted; });
    };
    const bone::ExactSurface made = exact_->finish(
        simulation_, [this](double fraction, const std::string& what) { report_progress(fraction, what); },
        is_interrupted);
    outcome_.was_interrupted = outcome_.was_interrupted || is_interrupted();
    outcome_.summary.exact = exact_row(made, *request_.strategies);
    for (RunObserver* observer : observers_) {
        const std::string error = observer->on_exact_surface(made);
        if (!error.empty()) outcome_.error += (outcome_.error.empty() ? "" : "\n      ") + error;
    }
}

/// Marks a step as not done if it follows a hole of an implant that was refused or forgotten.
void Run::mark_missed_implants() {
    session::RunSummary& summary = outcome_.summary;
    for (const StepState& state : monitor_.steps()) {
        const auto named = hole_of_step(scene_->procedure, *state.step);
        if (!named || !state.has_cut_bone()) continue;
        const auto bodies = simulation_.bodies();
        if (std::any_of(bodies.begin(), bodies.end(), [&](const auto& body) {
                return body->is_present && !body->is_cuttable && body->bone->id == named->implant->id;
            }))
            continue;
        summary.reasons.push_back("Step `" + state.step->id + "`: `" + named->implant->id +
                                  "`, whose hole it follows, was not in the scene.");
        if (summary.verdict == session::Verdict::pass) summary.verdict = session::Verdict::incomplete;
    }
}

void Run::measure() {
    session::RunSummary& summary = outcome_.summary;
    const PresentBone& bone = simulation_.present();
    summary.duration = static_cast<double>(simulation_.ticks()) * Simulation::dt;
    summary.ticks = simulation_.ticks();
    summary.removed = simulation_.present().removed();
    for (std::size_t m = 0; m < scene_->body.materials.size(); ++m)
        summary.removed_by_tissue.emplace_back(scene_->body.materials[m].id,
                                               simulation_.present().removed_of_material(m));
    summary.hash = hash_.value();
    judge(monitor_, end_, summary.duration, scene_->procedure.time_limit, summary);
    mark_missed_implants();
    if (end_ == RunEnd::fault) summary.reasons.front() += " " + text_of(simulation_.law_fault());
    outcome_.over_budget = simulation_.laws_over_budget();
    summary.metrics = metrics_of(monitor_, *scene_);
    std::move(left_.begin(), left_.end(), std::back_inserter(summary.metrics));
    if (simulation_.threads().count() > 0) summary.metrics.push_back(groove_row(simulation_.threads().volume()));
    summary.metrics.push_back(port_energy_row(simulation_.passivity()));
    for (std::size_t body = 0; body < bone.count(); ++body)
        summary.pieces.push_back({body, bone_volume(*bone.piece(body).bone, bone.cut(body)),
                                  surface_file(body, !simulation_.bodies()[body]->is_cuttable),
                                  !simulation_.bodies()[body]->is_cuttable});
    for (session::MetricRow& row :
         piece_metrics(summary, bone_volume(scene_->body, CutField(scene_->body, 0)) + bone.added(), bone.crumbs(),
                       bone.crumb_volume()))
        summary.metrics.push_back(std::move(row));
    outcome_.is_as_expected = ended_as_expected(*rehearsal_, monitor_, summary.verdict);
}

}  // namespace kerf::run
