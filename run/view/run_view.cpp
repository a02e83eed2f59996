// SPDX-License-Identifier: Apache-2.0
#include "run/view/run_view.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include "run/arm_views.h"
#include "run/run.h"
#include "run/view/event_view.h"
#include "run/view/result_view.h"
#include "session/recorder.h"

namespace kerf::run {

namespace {

constexpr std::uint64_t moment_interval = 16, surface_interval = 32;  // [ticks]

/// Returns whether a step has its help without a request.
bool is_helped_from_the_start(ViewedScene::Assist assist) {
    return assist == ViewedScene::Assist::full || assist == ViewedScene::Assist::stepwise;
}

/// Moves all elements to the end of another list.
template <class T>
void take_all(std::vector<T>& from, std::vector<T>& to) {
    to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
    from.clear();
}

}  // namespace

RunView::RunView(const Scene& scene, const ViewedSetting& setting, std::optional<double> duration)
    : scene_(&scene),
      viewed_(viewed_scene(scene, setting)),
      folder_(setting.folder),
      language_(setting.language),
      duration_(duration),
      inspector_(scene.procedure.spacing),
      radiograph_worker_(viewed_, [this](std::shared_ptr<const ViewedRadiograph> made) {
          const std::lock_guard lock(mutex_);
          radiographs_.push_back(made);
          radiograph_ = std::move(made);
      }) {
    for (const ArmView& view : arm_views) viewed_.arms.push_back({view.words, view.about_head_axis, view.tilt});
    for (std::size_t m = 0; m < scene.body.materials.size(); ++m)
        if (scene.body.materials[m].id == "cortical") cortical_.push_back(static_cast<std::int32_t>(m));
    for (const documents::Zone& zone : scene.anatomy.zones) displays_.push_back(display_of(zone, scene.procedure));
}

RunView::~RunView() = default;

// ---- the run's thread ---------------------------------------------------------------------------------------------

void RunView::on_begin(Run& run) {
    run_ = &run;
    state_.world_from_tool = run.simulation().world_from_tool();
    state_.world_from_handle = state_.world_from_tool;
    state_.device_scale = scene_->gains.force_scale;
    state_.limit_values.fill(std::numeric_limits<float>::quiet_NaN());
    state_.has_help = is_helped_from_the_start(viewed_.assist);
    show_bodies();
    show_zone();
    show_surface();
    show_step();
    show_moment();
    newest_.put(state_);
}

void RunView::on_event(const session::EventRow& event) {
    if (event.id == session::missed_event)
        state_.late_ticks += static_cast<std::uint32_t>(std::strtoul(event.detail.c_str(), nullptr, 10));
    if (event.id == session::hand_input_event)
        if (const auto input = documents::hand_input(event.detail);
            input && input->kind == documents::HandInput::Kind::image)
            image_ = *input;
    if (event.id == session::image_taken_event) take_radiograph(event.time);
    if (event.id == session::assist_used_event) state_.has_help = true;
    auto viewed = viewed_event(event);
    if (!viewed || viewed_.is_examination) return;
    viewed->words = translated(std::move(viewed->words));
    const std::lock_guard lock(mutex_);
    events_.push_back(std::move(*viewed));
}

void RunView::on_tick(const session::TickRow& row) {
    show_tick(row);
    new_rows_.push_back({row.time, static_cast<float>(state_.force), static_cast<float>(state_.hand_force),
                         static_cast<float>(state_.torque), static_cast<float>(state_.turned),
                         static_cast<float>(state_.depth), row.step});
    if (row.tick % moment_interval == 0) {
        show_bodies();
        show_zone();
        show_step();
        if (row.tick % surface_interval == 0) show_surface();
        inspection_ =
            is_inspecting_ ? inspector_.inspect(run_->simulation(), run_->last(), row.device_from_handle) : nullptr;
        show_moment();
    }
    newest_.put(state_);
    if (is_image_wanted_ || is_help_wanted_) pass_requests_on();
}

/// Requests the image and the help that the viewer wants. The run takes them before its next tick.
void RunView::pass_requests_on() {
    if (is_help_wanted_.exchange(false)) run_->request({documents::HandInput::Kind::assist});
    if (!is_image_wanted_ || !radiograph_worker_.is_idle()) return;
    const std::lock_guard lock(mutex_);
    is_image_wanted_ = false;
    run_->request(wanted_image_);
}

/// Returns a text in the language of the viewer.
std::string RunView::translated(std::string text) const {
    return scene_->procedure.translations.within(std::move(text), language_);
}

/// Gives the worker a copy of all that a radiograph shows. The run waits for that copy alone.
void RunView::take_radiograph(double time) {
    ++state_.shots;
    show_bodies();
    Vec3 target{};  // the middle of the step's axis
    if (!viewed_.steps.empty()) {
        const auto number = static_cast<std::size_t>(std::max(0, state_.step));
        const ViewedStep& step = viewed_.steps[std::min(number, viewed_.steps.size() - 1)];
        target = step.entry + 0.5 * step.depth_goal.value_or(0.0) * step.along;
    }
    radiograph_worker_.make({.bone = picture_of(run_->present()),
                             .state = state_,
                             .target = target,
                             .radiograph = {.time = time,
                                            .shot = static_cast<int>(state_.shots),
                                            .words = arm_words(image_.value, image_.tilt),
                                            .about_head_axis = image_.value,
                                            .tilt = image_.tilt}});
}

/// Lets the viewer take a moment, and the rows up to it.
void RunView::show_moment() {
    const std::lock_guard lock(mutex_);
    moments_.push_back({state_, surface_, inspection_});
    rows_.insert(rows_.end(), new_rows_.begin(), new_rows_.end());
    new_rows_.clear();
}

/// Sets all that changes with each tick.
void RunView::show_tick(const session::TickRow& row) {
    const TickResult& result = run_->last();
    if (row.step != state_.step) {
        state_.turned = 0.0;
        state_.has_help = is_helped_from_the_start(viewed_.assist);
        state_.cortices = 0;
        was_in_cortex_ = false;
    }
    state_.tick = row.tick + 1;
    state_.time = row.time;
    state_.step = row.step < 0 ? static_cast<std::int32_t>(viewed_.steps.size()) : row.step;
    state_.tool = static_cast<std::uint32_t>(run_->simulation().tool());
    state_.turned += result.rate[5] * Simulation::dt;
    state_.world_from_tool = row.world_from_tool;
    state_.world_from_handle = row.device_from_handle;
    state_.thrust = row.thrust;
    state_.torque = row.torque;
    state_.force_on_tool = linear(row.modelled);
    state_.force = length(state_.force_on_tool);
    state_.hand_force = length(linear(row.commanded)) / state_.device_scale;
    state_.depth = row.depth;
    state_.feed = row.feed_rate;
    state_.removed = row.removed;
    state_.is_running = result.is_cutting;
    state_.is_gate_closed = result.is_closed_or_closing;
    state_.is_faulty = result.is_quarantined;
    add_cortex(row.tissue);
    state_.tissue = row.tissue;
}

/// Counts a cortex when the tip has left it.
void RunView::add_cortex(std::int32_t tissue) {
    const bool is_in = std::find(cortical_.begin(), cortical_.end(), tissue) != cortical_.end();
    if (was_in_cortex_ && !is_in) ++state_.cortices;
    was_in_cortex_ = is_in;
}

void RunView::show_bodies() {
    const auto bodies = run_->simulation().bodies();
    state_.body_count = static_cast<std::uint32_t>(std::min(bodies.size(), max_viewed_bodies));
    for (std::size_t b = 0; b < state_.body_count; ++b) {
        const LiveBody& live = *bodies[b];
        ViewedBody& viewed = state_.bodies[b];
        viewed.world_from_body = live.world_from_body;
        viewed.kind = !live.is_present   ? ViewedBody::Kind::absent
                      : live.is_cuttable ? ViewedBody::Kind::bone
                                         : ViewedBody::Kind::metal;
        for (std::size_t t = 0; t < scene_->staying.size(); ++t)
            if (scene_->staying[t] && live.bone == &*scene_->staying[t] && live.is_present) {
                viewed.kind = ViewedBody::Kind::staying_part;
                viewed.shape = static_cast<std::uint16_t>(t);
            }
        for (std::size_t i = 0; i < scene_->implants.size(); ++i)
            if (live.bone == &scene_->implants[i] && live.is_present) {
                viewed.kind = ViewedBody::Kind::implant;
                viewed.shape = static_cast<std::uint16_t>(i);
            }
    }
}

void RunView::show_surface() {
    std::vector<bool> is_drawn;
    for (const auto& live : run_->simulation().bodies()) is_drawn.push_back(live->is_cuttable);
    const auto made = surfaces_.update(run_->present(), is_drawn);
    if (made == nullptr) return;
    const std::lock_guard lock(mutex_);
    surface_ = made;
}

/// Returns whether a zone is drawn now. A replay shows a run that is over.
bool RunView::is_shown(const documents::ZoneDisplay& display, double distance) const {
    using Show = documents::ZoneDisplay::Show;
    if (duration_ || state_.is_over) return true;
    if (!state_.has_help || display.show == Show::after) return false;
    return display.show != Show::near || distance <= display.within;
}

void RunView::show_zone() {
    state_.zone = -1;
    state_.zone_distance = HUGE_VAL;
    state_.shown_zones = 0;
    if (viewed_.assist == ViewedScene::Assist::off) return;
    const std::vector<documents::Zone>& zones = scene_->anatomy.zones;
    const auto& owners = run_->monitor().owners().zone;
    const auto bodies = run_->simulation().bodies();
    for (std::size_t z = 0; z < zones.size(); ++z) {
        const std::size_t owner = owners.empty() ? 0 : owners[z];
        const Pose& world_from_zone = bodies[owner]->world_from_body;
        if (z < max_viewed_zones) state_.zone_body[z] = static_cast<std::uint8_t>(owner);
        if (viewed_.zones[z].mesh.triangles.empty()) continue;
        const double distance = clearance(run_->simulation().outline().cutting,
                                          inverse(world_from_zone) * state_.world_from_tool, zones[z]);
        if (!is_shown(displays_[z], distance)) continue;
        if (z < 32) state_.shown_zones |= 1u << z;
        if (distance >= state_.zone_distance) continue;
        state_.zone = static_cast<std::int32_t>(z);
        state_.zone_distance = distance;
    }
}

void RunView::show_step() {
    const StepMonitor& monitor = run_->monitor();
    if (monitor.current() < monitor.steps().size()) {
        const StepState& step = monitor.steps()[monitor.current()];
        state_.goals_done = state_.broken = 0;
        state_.limit_values.fill(std::numeric_limits<float>::quiet_NaN());
        for (std::size_t g = 0; g < step.goal_done.size() && g < 32; ++g)
            if (step.goal_done[g]) state_.goals_done |= 1u << g;
        for (std::size_t i = 0; i < viewed_.steps[monitor.current()].limits.size() && i < max_viewed_limits; ++i) {
            const LimitState& limit = step.limits[i];
            if (limit.broken_at) state_.broken |= 1u << i;
            if (limit.is_seen) state_.limit_values[i] = static_cast<float>(limit.worst);
        }
    }
    std::string next = viewed_.is_examination ? "" : run_->next_action();
    const std::lock_guard lock(mutex_);
    next_action_ = std::move(next);
}

std::optional<RunEnd> RunView::end() { return should_stop_ ? std::optional(RunEnd::interrupted) : std::nullopt; }

std::string RunView::on_result(const session::RunSummary& summary, const Simulation& /*simulation*/) {
    state_.is_over = true;
    show_bodies();
    show_zone();
    show_surface();
    show_moment();
    newest_.put(state_);
    ViewedResult result = viewed_result(summary, folder_);
    for (ViewedResult::Deduction& deduction : result.deductions)
        deduction.words = translated(std::move(deduction.words));
    for (std::string& reason : result.reasons) reason = translated(std::move(reason));
    const std::lock_guard lock(mutex_);
    result_ = std::move(result);
    return {};
}

// ---- the viewer's thread ------------------------------------------------------------------------------------------

/// A run ends between two ticks, and a paused one has none.
void RunView::lead(const MouseTotals& totals) noexcept {
    if (mouse_ == nullptr) return;
    totals_ = totals;
    if (should_stop_ || (is_interrupted_ && is_interrupted_())) totals_.is_paused = false;
    mouse_->put(totals_);
}

void RunView::stop() noexcept {
    should_stop_ = true;
    lead(totals_);
}

bool RunView::take(ViewedState& state) noexcept {
    state = newest_.get();
    const std::uint64_t number = 2 * state.tick + (state.is_over ? 1 : 0);
    return std::exchange(seen_, number) != number;
}

void RunView::take(std::vector<ViewedRow>& rows) {
    const std::lock_guard lock(mutex_);
    take_all(rows_, rows);
}

void RunView::take(std::vector<ViewedEvent>& events) {
    const std::lock_guard lock(mutex_);
    take_all(events_, events);
}

void RunView::take(std::vector<ViewedMoment>& moments) {
    const std::lock_guard lock(mutex_);
    take_all(moments_, moments);
}

void RunView::take(std::vector<std::shared_ptr<const ViewedRadiograph>>& radiographs) {
    const std::lock_guard lock(mutex_);
    take_all(radiographs_, radiographs);
}

std::shared_ptr<const ViewedRadiograph> RunView::radiograph() const {
    const std::lock_guard lock(mutex_);
    return radiograph_;
}

void RunView::request_radiograph(double about_head_axis, double tilt) {
    if (duration_ || !is_arm_angle(about_head_axis) || !is_arm_angle(tilt)) return;
    const std::lock_guard lock(mutex_);
    wanted_image_ = {documents::HandInput::Kind::image, {}, about_head_axis, tilt};
    is_image_wanted_ = true;
}

void RunView::request_help() {
    if (!duration_ && viewed_.assist == ViewedScene::Assist::on_request) is_help_wanted_ = true;
}

std::shared_ptr<const ViewedSurface> RunView::surface() const {
    const std::lock_guard lock(mutex_);
    return surface_;
}

std::string RunView::next_action() const {
    const std::lock_guard lock(mutex_);
    return next_action_;
}

std::optional<ViewedResult> RunView::result() const {
    const std::lock_guard lock(mutex_);
    return result_;
}

}  // namespace kerf::run
