// SPDX-License-Identifier: Apache-2.0
#include "run/run.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "bone/exact/exact_follower.h"
#include "core/field/cut/removed_volume.h"
#include "core/plugin/reserved_names.h"
#include "run/arm_views.h"
#include "run/body_ownership.h"
#include "run/exact/exact_files.h"
#include "run/exact/exact_strategies.h"
#include "run/live/loop_link.h"
#include "run/plate_steps.h"
#include "run/recorded_pose.h"
#include "run/tick_row.h"
#include "run/verdict/measure_bone.h"
#include "run/verdict/run_metrics.h"
#include "run/verdict/score.h"
#include "run/zone_rows.h"
#include "text/quantity.h"

namespace kerf::run {

namespace {

constexpr int volume_interval = 50;  // ticks between counts of the removed volume
constexpr double crumb = 10e-9;      // [m³] smaller pieces do not become bodies: they are washed away

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

/// In the version of a plugin that has a name of Kerf's own plugins; it comes from another folder.
constexpr const char* allowed_for_this_run = " of another folder, allowed for this run";

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
    summary.hand = !request.replay.empty()   ? "replay"
                   : request.leader.empty()  ? "simulated"
                   : request.is_led_by_mouse ? "mouse"
                                             : "device";
    summary.leader = request.leader;
    summary.leader_setup = request.leader_setup;
    if (request.beginning != nullptr) {
        summary.parent = request.beginning->parent;
        summary.parent_ticks = request.beginning->ticks;
    }
    summary.device = scene.device->id;
    summary.force_scale = scene.gains.force_scale;
    summary.coupling_stiffness = scene.procedure.is_direct ? 0.0 : scene.gains.stiffness;
    summary.versions.emplace_back("kerf", KERF_VERSION);
    for (const auto& plugin : plugins.plugins())
        summary.versions.emplace_back(plugin->entry().plugin_id,
                                      std::string(plugin->entry().plugin_version) +
                                          (is_foreign_name(plugin->entry().plugin_id) ? allowed_for_this_run : ""));
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
    const documents::Rehearsal& rehearsal = rehearsal_of(scene.procedure, request.rehearsal);
    session::RunSummary summary = summary_of(scene, plugins, request, rehearsal, SignalTable(scene.tools));
    std::unique_ptr<SessionFiles> files;
    if (!request.out.empty()) {
        files = SessionFiles::create(scene, request, summary, refusal);
        if (files == nullptr) return nullptr;
    }
    auto run = std::unique_ptr<Run>(new Run(scene, request, rehearsal, std::move(summary), std::move(files)));
    for (RunObserver* observer : run->observers_) observer->on_begin(*run);
    return run;
}

Run::Run(const Scene& scene, const RunRequest& request, const documents::Rehearsal& rehearsal,
         session::RunSummary summary, std::unique_ptr<SessionFiles> files)
    : files_(std::move(files)),
      observers_(request.observers),
      scene_(&scene),
      request_(request),
      is_led_(!request.leader.empty()),
      rehearsal_(&rehearsal),
      signals_(scene.tools),
      plan_(plan_of(rehearsal, scene)),
      hand_(plan_),
      simulation_(scene.body, scene.tools, scene.gains, plan_.start),
      changes_(simulation_),
      monitor_(scene.procedure, scene.anatomy, scene.frames),
      next_actions_(rehearsal),
      world_from_body_(1, identity_pose()) {
    if (files_ != nullptr) observers_.insert(observers_.begin(), files_.get());
    if (request_.is_examination())
        hash_.add(std::uint32_t{1});
    else if (const auto assist = request_.assist_with(scene.procedure); assist != scene.procedure.assist)
        hash_.add(std::uint32_t{2} + static_cast<std::uint32_t>(assist));
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
    if (is_replay()) changes_.begin_replay(request_.late_changes);
}

Run::~Run() = default;

// ---- a tick -------------------------------------------------------------------------------------------------------

bool Run::step() {
    take_passive_inputs();
    if (changes_.is_in_lock_step()) take_tool_of_step();
    make_due_changes();
    if (is_replay()) {
        take_recorded_inputs();
        return tick(recorded_reading());
    }
    take_rehearsed_inputs();
    if (!requested_.empty()) take_hand_inputs(std::exchange(requested_, {}));
    return tick({.world_from_handle = hand_.reported()});
}

bool Run::step(const DeviceSample& sample) {
    is_led_ = true;
    take_passive_inputs();
    take_tool_of_step();
    take_hand_inputs(std::exchange(requested_, {}));
    return tick(sample);
}

void Run::take_rehearsed_inputs() {
    const RehearsedHand::Inputs due = hand_.take_inputs();
    if (due.loosens) take_hand_inputs({{documents::HandInput::Kind::regrip, {}, *due.loosens ? 1.0 : 0.0}});
    if (due.leg) take_hand_inputs(plan_.inputs[*due.leg]);
}

void Run::take_recorded_inputs() {
    const RecordedInputs& recorded = request_.hand_inputs;
    std::vector<documents::HandInput> inputs;
    for (; next_input_ < recorded.size() && recorded[next_input_].first <= simulation_.ticks(); ++next_input_)
        inputs.push_back(recorded[next_input_].second);
    if (!inputs.empty()) take_hand_inputs(inputs);
}

/// Takes the passive inputs that were requested, or recorded, before the coming tick: before all else.
void Run::take_passive_inputs() {
    const auto is_one = [](const documents::HandInput& input) { return is_passive(input.kind); };
    if (is_replay()) {
        const RecordedInputs& recorded = request_.hand_inputs;
        for (; next_input_ < recorded.size() && recorded[next_input_].first <= simulation_.ticks() &&
               is_one(recorded[next_input_].second);
             ++next_input_)
            take_passive(recorded[next_input_].second);
        requested_.clear();
        return;
    }
    for (const documents::HandInput& input : requested_)
        if (is_one(input)) take_passive(input);
    std::erase_if(requested_, is_one);
    if (changes_.is_following()) requested_.clear();
}

/// Records a radiograph or a request for help. Observers show it.
void Run::take_passive(const documents::HandInput& input) {
    const std::uint64_t tick = simulation_.ticks();
    add_event_at(tick, session::hand_input_event, text_of(input));
    std::string why_not = carry_out(input, *scene_, simulation_);
    if (why_not.empty() && input.kind == documents::HandInput::Kind::assist) why_not = help();
    if (!why_not.empty()) return add_event_at(tick, "hand.refused", text_of(input) + ": " + why_not);
    if (input.kind != documents::HandInput::Kind::image) return;
    ++images_;
    add_event_at(tick, session::image_taken_event, arm_words(input.value, input.tilt) + " " + std::to_string(images_));
}

/// Gives help with the running step. Returns the reason if it cannot.
std::string Run::help() {
    const documents::Assist assist = request_.assist_with(scene_->procedure);
    if (assist != documents::Assist::on_request)
        return assist == documents::Assist::off ? "the run has no help" : "the help is there without a request";
    const std::size_t step = monitor_.current();
    if (step >= monitor_.steps().size()) return "all steps are done";
    if (helped_step_ == step) return "the step has its help already";
    helped_step_ = step;
    ++helps_;
    add_event_at(simulation_.ticks(), session::assist_used_event, scene_->procedure.steps[step].id);
    return {};
}

// ---- a loop on the clock ------------------------------------------------------------------------------------------

std::unique_ptr<HapticLoop> Run::follow_loop(LoopLink& link) {
    constexpr std::size_t free_bricks = 4096;  // 6 MB for each body: memory that no tick touches for the first time
    auto loop = simulation_.second_loop(scene_->tools, scene_->gains, plan_.start, free_bricks);
    loop->lead(guide_of_step(*scene_, monitor_));
    changes_.begin_following(link);
    if (const RunBeginning* beginning = request_.beginning.get())
        changes_.repeat(beginning->run.late_changes, beginning->run.adoptions, beginning->ticks);
    return loop;
}

bool Run::take(const LoopMessage& message) {
    using Kind = LoopMessage::Kind;
    using documents::HandInput;
    // Each of these messages is followed by one of a tick.
    if (message.kind != Kind::ended && !std::exchange(has_begun_tick_, message.kind != Kind::tick))
        take_passive_inputs();
    switch (message.kind) {
        case Kind::tick:
            return follow_tick(message);
        case Kind::changed:
        case Kind::refused:
            make_change(message.kind == Kind::refused);
            break;
        case Kind::outdated:
            changes_.renew();
            break;
        case Kind::separation:
            changes_.renew_separation();
            changes_.post_separation(!waiting_.empty());
            break;
        case Kind::leg:
            take_hand_inputs(plan_.inputs[message.index]);
            break;
        case Kind::action:
            next_actions_.took(message.index);
            take_hand_inputs(next_actions_.inputs(message.index));
            break;
        case Kind::drive:
            take_hand_inputs(
                {{HandInput::Kind::drive, simulation_.setup().tool->tool->drives[message.index].id, message.value}});
            break;
        case Kind::regrip:
            take_hand_inputs({{HandInput::Kind::regrip, {}, message.value}});
            break;
        case Kind::undo:
            take_hand_inputs({{HandInput::Kind::undo}});
            break;
        case Kind::repeated: {
            const HandInput& input = request_.beginning->run.hand_inputs[message.index].second;
            next_actions_.follow(monitor_.current(), input);
            take_hand_inputs({input});
            break;
        }
        case Kind::pause:
            take_hand_inputs({{HandInput::Kind::pause}});
            break;
        case Kind::ended:
            end_ = static_cast<RunEnd>(message.index);
            return false;
    }
    post_changes();
    return true;
}

bool Run::follow_tick(const LoopMessage& message) {
    if (message.has_adopted) changes_.adopt();
    const bool has_more = tick(message.sample);
    if (bits_of(result_) == message.bits) return has_more;
    end_ = RunEnd::diverged;
    return false;
}

/// Gives the loop what was decided. A change of bodies waits until no separated part waits.
void Run::post_changes() {
    changes_.post_separation(!waiting_.empty());
    make_waiting_changes();
    changes_.post(monitor_.current());
    changes_.show_busy(!waiting_.empty());
}

/// Makes the changes that a replayed loop took over before this tick.
void Run::make_due_changes() {
    if (changes_.is_in_lock_step()) return;
    post_changes();
    while (const auto due = changes_.due()) {
        make_change(due->is_refused);
        post_changes();
    }
}

/// Makes the posted change before the next tick, or drops it.
void Run::make_change(bool is_refused) {
    const LoopChanges::Made made = changes_.make(is_refused);
    if (made.is_late)
        add_event_at(simulation_.ticks(), session::late_change_event,
                     std::to_string(made.number) + (made.is_refused ? " refused" : ""));
    if (made.has_closed_stretches) pass_cuts_on();
    if (made.tool) note_tool(*made.tool);
    const auto input = std::exchange(changing_, std::nullopt);
    if (input && made.is_refused)
        add_event_at(simulation_.ticks(), "hand.refused", text_of(*input) + ": the tool has met bone since");
    else if (input)
        finish_input(*input);
    else
        before_.follow(simulation_.present());
}

void Run::make_waiting_changes() {
    while (!waiting_.empty() && changes_.is_free()) {
        const auto next = std::move(waiting_.front());
        waiting_.pop_front();
        changes_.delay();
        if (const auto* left = std::get_if<LeftImplant>(&next))
            note_left(*left, insert(*left));
        else
            change(std::get<documents::HandInput>(next));
    }
}

// ---- a tick, its parts --------------------------------------------------------------------------------------------

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
    note_reading(reported);
    if (!is_replay() && !is_led_ && !changes_.is_following()) hand_.feel(result_, simulation_);

    if (simulation_.ticks() % volume_interval == 0) follow_removal();
    take_separations(simulation_.ticks() - 1);
    if (exact_ != nullptr) exact_->follow(simulation_);
    const double now = static_cast<double>(simulation_.ticks() - 1) * Simulation::dt;
    const std::size_t step = monitor_.current();
    const bool has_tool = !changes_.awaits_tool();  // of the step
    observe(handle, now, has_tool);
    if (monitor_.current() != step) end_step(step, now);
    if (monitor_.needs_measures()) monitor_.show_measures(measured_bone());
    for (std::size_t i = 0; i < result_.event_count; ++i) {
        add_event(result_.events[i], event_detail(result_.events[i], simulation_));
        if (has_tool) monitor_.report(result_.events[i], now);
        add_monitor_events();
    }
    if (const auto end = end_after_tick()) {
        end_ = *end;
        return false;
    }
    if (simulation_.ticks() >= static_cast<std::uint64_t>(scene_->procedure.time_limit / Simulation::dt)) return false;
    if (!changes_.is_in_lock_step()) {
        if (result_.is_stripping) changes_.delay();  // in lock-step, within the tick
        take_tool_of_step();
        post_changes();
    }
    return true;
}

/// Counts the bone removed so far, and compares it with what the force law resisted.
void Run::follow_removal() {
    removed_ = simulation_.present().removed();
    const ToolSetup& tool = simulation_.setup();
    if (const auto odd =
            laws_.follow(removed_, simulation_.ledger(), tool.tool->tool->drive_count > 0, name_of_law(*tool.force)))
        add_event(LawChecks::forceless, *odd);
}

void Run::take_tool_of_step() {
    const std::size_t tool = scene_->tool_of_step[monitor_.current()];
    if (tool == tool_ && !is_tool_left_) return;
    tool_ = tool;
    is_tool_left_ = false;
    changes_.take_tool(tool, std::exchange(back_, 0.0));
    if (!changes_.is_in_lock_step()) return;
    hand_.take_tool();
    pass_cuts_on();
    note_tool(tool);
}

/// Records that another tool was taken.
void Run::note_tool(std::size_t tool) {
    take_separations(simulation_.ticks());
    if (const auto odd = laws_.end_tool(removed_)) add_event_at(simulation_.ticks(), LawChecks::forceless, *odd);
    add_event_at(simulation_.ticks(), "tool.taken", instrument_of(*scene_, tool).id);
    laws_.restart(removed_, simulation_.ledger());
}

void Run::take_hand_inputs(const std::vector<documents::HandInput>& inputs) {
    for (const documents::HandInput& input : inputs) {
        if (is_passive(input.kind)) {
            take_passive(input);
            continue;
        }
        add_event_at(simulation_.ticks(), session::hand_input_event, text_of(input));
        if (is_immediate(input.kind)) {
            if (const std::string why_not = carry_out(input, *scene_, simulation_); !why_not.empty())
                add_event_at(simulation_.ticks(), "hand.refused", text_of(input) + ": " + why_not);
        } else if (waiting_.empty() && changes_.is_free()) {
            change(input);
        } else {
            waiting_.emplace_back(input);
        }
    }
    make_due_changes();
}

/// Carries out an input that changes bodies or ends a step.
void Run::change(const documents::HandInput& input) {
    using Kind = documents::HandInput::Kind;
    std::string why_not;
    if (input.kind == Kind::remove) {
        if (simulation_.held() < 0)
            why_not = "nothing is held";
        else
            changes_.remove_held();
    } else if (request_.is_examination() && (input.kind == Kind::undo || input.kind == Kind::redo)) {
        why_not = "an examination has no undo";
    } else {
        why_not = carry_out(input, *scene_, simulation_);
        if (why_not.empty() && input.kind == Kind::release) why_not = monitor_.release();
    }
    if (!why_not.empty()) {
        add_event_at(simulation_.ticks(), "hand.refused", text_of(input) + ": " + why_not);
    } else if (changes_.is_in_lock_step() || input.kind == Kind::release) {
        if (input.kind == Kind::undo || input.kind == Kind::redo || input.kind == Kind::subtract) pass_cuts_on();
        finish_input(input);
    } else {
        changing_ = input;
    }
}

/// Follows an input that has changed the bodies.
void Run::finish_input(const documents::HandInput& input) {
    using Kind = documents::HandInput::Kind;
    if (input.kind == Kind::undo || input.kind == Kind::redo) pass_owners_on();
    if (!scene_->holes.empty()) {
        follow_plates(*scene_, simulation_, monitor_);
        lead();
    }
    before_.follow(simulation_.present());
}

void Run::observe(const Pose& handle, double now, bool has_tool) {
    world_from_body_.clear();
    for (const auto& body : simulation_.bodies()) world_from_body_.push_back(body->world_from_body);
    const Vec3 tip = result_.world_from_tool.position;
    const std::int32_t tissue = tissue_at(*scene_, simulation_, tip);
    if (!has_tool)
        monitor_.wait(now);
    else
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

/// Ends the step that was done in this tick. A loop on the clock gets its next tool first, before the step is judged.
void Run::end_step(std::size_t step, double now) {
    const bool is_in_lock_step = changes_.is_in_lock_step(), is_last = monitor_.current() >= monitor_.steps().size();
    const auto left = left_implant(step);
    const bool is_left_now = left && waiting_.empty() && changes_.is_free();
    std::string why_not;
    if (!is_in_lock_step) {
        if (is_left_now) why_not = insert(*left);
        if (left && !is_left_now) waiting_.emplace_back(*left);
        if (!is_last) {
            lead();
            take_tool_of_step();
        }
        post_changes();
    }
    judge_step(step, now);
    if (is_left_now) {
        if (is_in_lock_step) why_not = insert(*left);
        note_left(*left, why_not);
    }
    removed_before_step_ = removed_;
    before_.begin(simulation_.present());
    if (is_in_lock_step && !is_last) lead();
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
}

std::vector<documents::MeasureReading> Run::measured_bone() const {
    return measure_bone(*scene_, simulation_.present(), world_from_body_);
}

/// Returns the implant that the tool of a step leaves in bone, if it is one. Its driver leaves it.
std::optional<Run::LeftImplant> Run::left_implant(std::size_t step) {
    const std::size_t tool = scene_->tool_of_step[step];
    if (!scene_->tools[tool].outline.is_implant()) return std::nullopt;
    is_tool_left_ = true;
    constexpr double clear = 5e-3;  // [m] distance from the bone
    back_ = std::max(0.0, monitor_.frame(step).depth_of(simulation_.world_from_tool().position)) + clear;
    for (session::MetricRow& row : implant_metrics(scene_->procedure.steps[step].id,
                                                   *scene_->tools[tool].setup.force->force, simulation_.signals()))
        left_.push_back(std::move(row));
    const std::size_t owner = monitor_.owners().step[step];
    const PresentBone& bone = simulation_.present();
    held_implants_.push_back(
        {step, HeldBone::around(scene_->tools[tool].outline,
                                inverse(simulation_.bodies()[owner]->world_from_body) * simulation_.world_from_tool(),
                                *bone.piece(owner).bone, bone.cut(owner))});
    const std::optional<Body>& implant = scene_->staying[tool];
    return LeftImplant{scene_->procedure.steps[step].instrument, implant ? &*implant : nullptr,
                       simulation_.world_from_tool(), owner};
}

/// Adds an implant that was left to the bodies. Returns the reason if it cannot.
std::string Run::insert(const LeftImplant& left) {
    return left.body != nullptr ? simulation_.insert(*left.body, left.world_from_body, false, left.owner) : "";
}

void Run::note_left(const LeftImplant& left, const std::string& why_not) {
    add_event("tool.left", why_not.empty() ? left.instrument : left.instrument + ", unseen: " + why_not);
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
    if (is_led_ || changes_.is_following()) return std::nullopt;
    if (is_replay() ? ticks >= request_.replay.size() : hand_.is_done()) return RunEnd::path_ended;
    return std::nullopt;
}

// ---- events, bodies, cuts -----------------------------------------------------------------------------------------

void Run::add_event_at(std::uint64_t tick, const std::string& id, const std::string& detail) {
    session::EventRow event;
    event.tick = tick;
    event.time = static_cast<double>(event.tick) * Simulation::dt;
    event.id = id;
    event.detail = detail;
    laws_.note(id, detail);
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
    const auto fraction = [](std::size_t done, std::size_t all) {
        return static_cast<double>(done) / static_cast<double>(all);
    };
    const std::uint64_t ticks = simulation_.ticks();
    const std::size_t step = monitor_.current();
    std::string what = "working, " + std::to_string(ticks / 1000) + " s simulated";
    if (is_led_ && step < scene_->procedure.steps.size()) {
        what = std::to_string(ticks / 1000) + " s, step `" + scene_->procedure.steps[step].id + "`";
        if (const std::string next = next_actions_.words(step); !next.empty()) what += "; the button next: " + next;
    }
    const double done = is_replay()                          ? fraction(ticks, request_.replay.size())
                        : is_led_ || changes_.is_following() ? fraction(step, scene_->procedure.steps.size())
                                                             : fraction(hand_.leg(), plan_.intent.legs.size());
    report_progress(std::min(done, 0.99), what);  // 1 is for the work after the last tick
}

/// Sets the sleeve of the running step, on the body that owns its axis.
void Run::lead() { changes_.lead(guide_of_step(*scene_, monitor_)); }

// ---- after the last tick ------------------------------------------------------------------------------------------

RunOutcome Run::finish() {
    // Bodies that a step has left are there although the loop takes nothing over any more; its tool is not.
    for (changes_.drop_tool(); changes_.is_posted(); changes_.post(monitor_.current())) {
        make_change(false);
        changes_.drop_tool();
    }
    if (files_ != nullptr) report_progress(1.0, "measuring the bone");
    simulation_.finish();
    if (simulation_.finish_ledger())
        add_event("haptics.law_made_energy", event_detail("haptics.law_made_energy", simulation_));
    make_last_changes();
    pass_cuts_on();
    // A tick that never runs: at its end, a replay also takes over the remaining parts.
    take_separations(simulation_.ticks());
    hash_.add(simulation_.present().hash());
    measure();
    if (exact_ != nullptr)
        finish_exact_surface();
    else if (request_.strategies != nullptr && !request_.strategies->why_not().empty())
        outcome_.summary.exact.emplace().why_not = request_.strategies->why_not();
    if (files_ != nullptr) files_->report_work([this](const std::string& what) { report_progress(1.0, what); });
    for (RunObserver* observer : observers_) {
        const std::string error = observer->on_result(outcome_.summary, simulation_);
        if (!error.empty()) outcome_.error += (outcome_.error.empty() ? "" : "\n      ") + error;
    }
    return std::move(outcome_);
}

/// Makes the changes that waited when the run ended: implants that were left. Inputs of the hand come too late.
void Run::make_last_changes() {
    if (waiting_.empty()) return;
    add_event_at(simulation_.ticks(), session::late_change_event, "0");  // a replay lets them wait, too
    for (const auto& one : std::exchange(waiting_, {})) {
        if (const auto* left = std::get_if<LeftImplant>(&one))
            note_left(*left, insert(*left));
        else
            add_event_at(simulation_.ticks(), "hand.refused",
                         text_of(std::get<documents::HandInput>(one)) + ": the run has ended");
    }
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
        summary.is_missing = true;
    }
}

void Run::judge_held_implants() {
    constexpr double enough_left = 0.9;  // of the bone around the thread [assumed]
    const PresentBone& bone = simulation_.present();
    const auto& bodies = simulation_.bodies();
    std::map<std::string, std::size_t> inserted;
    for (const HeldImplant& held : held_implants_) {
        const std::size_t owner = monitor_.owners().step[held.step];
        const std::optional<Body>& implant = scene_->staying[scene_->tool_of_step[held.step]];
        // Screws of one tool have one id. They were inserted in the order of their steps.
        const std::size_t number = implant ? inserted[implant->id]++ : 0;
        std::size_t found = 0;
        bool is_there = bodies[owner]->is_present;
        for (const auto& body : bodies)
            if (implant && !body->is_cuttable && body->bone->id == implant->id && found++ == number)
                is_there = is_there && body->is_present;
        const double left = is_there ? held.bone.part_left(*bone.piece(owner).bone, bone.cut(owner)) : 0.0;
        left_.push_back(bone_kept_row(scene_->procedure.steps[held.step].id, left));
        if (!is_there)
            monitor_.lose_goals(held.step, "the implant was no longer there");
        else if (left < enough_left)
            monitor_.lose_goals(held.step, "only " + std::to_string(static_cast<int>(100.0 * left)) +
                                               " % of the bone around the implant's thread was left");
    }
}

void Run::measure() {
    if (const auto odd = laws_.end_tool(removed_)) add_event_at(simulation_.ticks(), LawChecks::forceless, *odd);
    session::RunSummary& summary = outcome_.summary;
    const PresentBone& bone = simulation_.present();
    summary.duration = static_cast<double>(simulation_.ticks()) * Simulation::dt;
    summary.ticks = simulation_.ticks();
    summary.removed = simulation_.present().removed();
    for (std::size_t m = 0; m < scene_->body.materials.size(); ++m)
        summary.removed_by_tissue.emplace_back(scene_->body.materials[m].id,
                                               simulation_.present().removed_of_material(m));
    summary.hash = hash_.value();
    monitor_.end_run(summary.duration);
    judge_held_implants();
    judge(monitor_, end_, summary.duration, scene_->procedure.time_limit, summary);
    mark_missed_implants();
    if (end_ == RunEnd::fault) summary.reasons.front() += " " + text_of(simulation_.law_fault());
    laws_.judge(end_ == RunEnd::fault, summary);
    outcome_.over_budget = simulation_.laws_over_budget();
    summary.metrics = metrics_of(monitor_, *scene_);
    std::move(left_.begin(), left_.end(), std::back_inserter(summary.metrics));
    if (simulation_.threads().count() > 0) summary.metrics.push_back(groove_row(simulation_.threads().volume()));
    if (images_ > 0) summary.metrics.push_back(count_row("image.shots", images_, "Radiographs that were taken."));
    if (request_.assist_with(scene_->procedure) == documents::Assist::on_request)
        summary.metrics.push_back(count_row("assist.uses", helps_, "Steps for which the trainee has requested help."));
    summary.metrics.push_back(port_energy_row(simulation_.passivity()));
    for (session::MetricRow& row : laws_.rows(simulation_.ledger())) summary.metrics.push_back(std::move(row));
    for (std::size_t body = 0; body < bone.count(); ++body)
        summary.pieces.push_back({body, bone_volume(*bone.piece(body).bone, bone.cut(body)),
                                  surface_file(body, !simulation_.bodies()[body]->is_cuttable),
                                  !simulation_.bodies()[body]->is_cuttable});
    for (session::MetricRow& row :
         piece_metrics(summary, bone_volume(scene_->body, CutField(scene_->body, 0)) + bone.added(), bone.crumbs(),
                       bone.crumb_volume()))
        summary.metrics.push_back(std::move(row));
    score(monitor_, scene_->procedure, summary);
    add_zone_rows(monitor_, *scene_, simulation_, summary);
    outcome_.is_as_expected = ended_as_expected(*rehearsal_, monitor_, summary.verdict);
    for (const StepState& state : monitor_.steps()) {
        std::vector<std::size_t>& broken = outcome_.broken_limits.emplace_back();
        for (std::size_t i = 0; i < state.limits.size(); ++i)
            if (state.limits[i].broken_at) broken.push_back(i);
    }
}

}  // namespace kerf::run
