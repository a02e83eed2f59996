// SPDX-License-Identifier: Apache-2.0
#include "run/view/recorded_view.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <span>
#include <utility>

#include "core/haptics/scene/simulation.h"
#include "run/view/event_view.h"
#include "run/view/pointer_shape.h"
#include "run/view/recorded_bone.h"
#include "run/view/recorded_scene.h"
#include "run/view/result_view.h"
#include "session/recorder.h"
#include "session/report/read_run.h"
#include "text/printable.h"

namespace kerf::run {

namespace {

constexpr std::uint64_t moment_interval = 16;  // [ticks]
constexpr std::size_t max_ticks = 7'200'000;   // two hours

/// Returns a number, or 0 for one that is not finite: a law that failed leaves such.
double finite(double value) noexcept { return std::isfinite(value) ? value : 0.0; }
Vec3 finite(Vec3 v) noexcept { return {finite(v.x), finite(v.y), finite(v.z)}; }

bool is_plausible(const Pose& pose) noexcept {
    constexpr double farthest = 100.0, tolerance = 1e-3;  // [m], [–]
    const auto& [w, x, y, z] = pose.rotation;
    return length(pose.position) < farthest && std::abs(w * w + x * x + y * y + z * z - 1.0) < tolerance;
}

/// The axis of a step, estimated by the motion of its tool.
struct StepMotion {
    std::optional<Vec3> nearest{}, deepest{};  ///< [m] the tip where the depth was nearest to 0, and largest
    Vec3 along{0, 0, 1};                       ///< the axis of the tool where it was deepest
    double depth_near = 0.0, depth_far = 0.0, turned = 0.0;

    void add(const ViewedState& state) {
        const Vec3 tip = state.world_from_tool.position;
        if (!nearest || std::abs(state.depth) < std::abs(depth_near)) {
            nearest = tip;
            depth_near = state.depth;
        }
        if (!deepest || state.depth > depth_far) {
            deepest = tip;
            depth_far = state.depth;
            along = rotate(state.world_from_tool.rotation, {0, 0, 1});
        }
        turned = state.turned;
    }
};

}  // namespace

/// Makes the states of a run from the rows of its session.
class RecordedView::Reader final : public session::RowObserver {
public:
    explicit Reader(RecordedView& view) : view_(&view) {
        state_.has_help = true;  // the operation is over
        state_.shown_zones = ~0u;
    }

    void on_begin(const session::RecordedRun& run) override {
        view_->scene_ = recorded_scene(run);
        procedure_ = run.procedure;
        motions_.resize(view_->scene_.steps.size());
        for (std::size_t t = 0; t < run.summary.tissues.size(); ++t)
            if (run.summary.tissues[t] == "cortical") cortex_ = static_cast<std::int32_t>(t);
        const double scale = run.summary.force_scale;
        state_.device_scale = std::isfinite(scale) && scale > 0.0 ? scale : 1.0;
        state_.body_count = 1;
        state_.bodies[0] = {.kind = ViewedBody::Kind::bone, .world_from_body = identity_pose()};
        state_.zone_distance = HUGE_VAL;
        begin_step(-1);
    }
    void on_event(const session::EventRow& event) override { recorded_.push_back(event); }
    void on_tick(const session::TickRow& row) override;

    /// Returns why the rows cannot be shown, for people; empty if they can.
    [[nodiscard]] const std::string& fault() const noexcept { return fault_; }
    /// Completes the view with the data from the end of a run.
    /// @param why  see `RecordedView::read`
    void finish(const session::RecordedRun& run, const std::string& folder, const std::string& why);

private:
    void begin_step(std::int32_t step);
    void take_events(std::uint64_t tick);
    void take_event(const session::EventRow& event);
    void set_demand(const std::string& detail, bool is_done);
    void show(const session::TickRow& row);
    void estimate_axes();

    RecordedView* view_;
    session::RecordedProcedure procedure_;
    std::vector<session::EventRow> recorded_;
    std::size_t next_event_ = 0;
    std::vector<StepMotion> motions_;  ///< by step
    std::int32_t cortex_ = -1;         ///< index of the tissue; −1: there is none
    ViewedState state_;
    std::string fault_;
};

void RecordedView::Reader::begin_step(std::int32_t step) {
    state_.step = step;
    state_.turned = 0.0;
    state_.cortices = 0;
    state_.goals_done = state_.broken = 0;
    state_.limit_values.fill(std::numeric_limits<float>::quiet_NaN());
    const auto& steps = view_->scene_.steps;
    if (step >= 0 && static_cast<std::size_t>(step) < steps.size())
        state_.tool = static_cast<std::uint32_t>(steps[static_cast<std::size_t>(step)].tool);
}

void RecordedView::Reader::on_tick(const session::TickRow& row) {
    constexpr double longest_tick = 1.0;  // [s]
    if (!fault_.empty()) return;
    const bool is_first = view_->rows_.empty();
    const bool is_later = row.time >= 0.0 && (is_first || row.time > state_.time);
    if (!is_plausible(row.world_from_tool) || !is_later ||
        !(row.time <= longest_tick * static_cast<double>(row.tick + 1)))
        fault_ = "tick " + std::to_string(row.tick) + " has no pose or no time, so the file is damaged";
    else if (view_->rows_.size() == max_ticks)
        fault_ = "it has more than " + std::to_string(max_ticks) + " ticks";
    if (!fault_.empty()) return;
    show(row);
    take_events(row.tick);
    view_->rows_.push_back({state_.time, static_cast<float>(state_.force), static_cast<float>(state_.hand_force),
                            static_cast<float>(state_.torque), static_cast<float>(state_.turned),
                            static_cast<float>(state_.depth), state_.step});
    if (is_first || row.tick % moment_interval == 0) view_->moments_.push_back({state_, nullptr});
}

/// Sets all that changes with a tick.
void RecordedView::Reader::show(const session::TickRow& row) {
    const auto steps = static_cast<std::int32_t>(view_->scene_.steps.size());
    const std::int32_t step = row.step < 0 || row.step > steps ? steps : row.step;
    const Quat turn = conjugate(state_.world_from_tool.rotation) * row.world_from_tool.rotation;
    if (step != state_.step)
        begin_step(step);
    else
        state_.turned += small_rotation_vector(turn).z;
    state_.is_faulty = false;
    state_.tick = row.tick + 1;
    state_.time = row.time;
    state_.world_from_tool = row.world_from_tool;
    state_.world_from_handle = is_plausible(row.device_from_handle) ? row.device_from_handle : row.world_from_tool;
    state_.thrust = finite(row.thrust);
    state_.torque = finite(row.torque);
    state_.force_on_tool = finite(linear(row.modelled));
    state_.force = length(state_.force_on_tool);
    state_.hand_force = length(finite(linear(row.commanded))) / state_.device_scale;
    state_.depth = finite(row.depth);
    state_.feed = finite(row.feed_rate);
    state_.is_running = finite(row.removed) > state_.removed;
    state_.removed = finite(row.removed);
    const bool is_known = row.tissue >= 0 && static_cast<std::size_t>(row.tissue) < view_->scene_.tissues.size();
    if (cortex_ >= 0 && state_.tissue == cortex_ && row.tissue != cortex_) ++state_.cortices;
    state_.tissue = is_known ? row.tissue : -1;
    if (step < steps) motions_[static_cast<std::size_t>(step)].add(state_);
}

// ---- events -------------------------------------------------------------------------------------------------------

void RecordedView::Reader::take_events(std::uint64_t tick) {
    for (; next_event_ < recorded_.size() && recorded_[next_event_].tick <= tick; ++next_event_)
        take_event(recorded_[next_event_]);
}

void RecordedView::Reader::take_event(const session::EventRow& event) {
    if (event.id == session::missed_event)
        state_.late_ticks += static_cast<std::uint32_t>(std::strtoul(event.detail.c_str(), nullptr, 10));
    if (event.id == session::image_taken_event) {
        ++state_.shots;
        view_->radiographs_.push_back(std::make_shared<const ViewedRadiograph>(
            ViewedRadiograph{.time = event.time,
                             .shot = static_cast<int>(state_.shots),
                             .words = text::printable(event.detail),
                             .error = "a record stores no radiograph. Its procedure can make it again."}));
    }
    if (event.id == "tool.left" || event.id == "tool.taken") state_.is_tool_in_hand = event.id == "tool.taken";
    if (event.id == "haptics.quarantined") state_.is_faulty = true;
    if (event.id == "goal_reached" || event.id == "goal_lost") set_demand(event.detail, event.id == "goal_reached");
    if (event.id == "limit_broken" || event.id == "zone_entered") set_demand(event.detail, false);
    auto viewed = viewed_event(event);
    if (!viewed || !std::isfinite(viewed->time)) return;
    viewed->words = text::printable(viewed->words);
    view_->events_.push_back(std::move(*viewed));
}

/// Sets the bit of a goal of the running step by "step: name", or of a limit by its name.
void RecordedView::Reader::set_demand(const std::string& detail, bool is_done) {
    const auto step = static_cast<std::size_t>(std::max(0, state_.step));
    if (step >= procedure_.steps.size()) return;
    const session::RecordedStep& running = procedure_.steps[step];
    constexpr std::size_t bits = 32;
    if (detail.starts_with(running.id + ": ")) {
        const std::size_t goal = index_of(running.goals, detail.substr(running.id.size() + 2));
        if (goal >= std::min(bits, running.goals.size())) return;
        state_.goals_done = is_done ? state_.goals_done | 1u << goal : state_.goals_done & ~(1u << goal);
    } else if (const std::size_t limit = index_of(running.limits, detail);
               limit < std::min(bits, running.limits.size())) {
        state_.broken |= 1u << limit;
    }
}

// ---- after the last tick ------------------------------------------------------------------------------------------

/// Sets where the camera and the plot of a step begin: its axis is not part of the record.
void RecordedView::Reader::estimate_axes() {
    constexpr double turn = 6.283185307179586, few_turns = 1.5;
    for (std::size_t s = 0; s < motions_.size(); ++s) {
        const StepMotion& motion = motions_[s];
        ViewedStep& step = view_->scene_.steps[s];
        if (!motion.nearest) continue;
        step.along = normalized(motion.along);
        step.entry = *motion.nearest - motion.depth_near * step.along;
        const double turns = std::abs(motion.turned) / turn, deep = motion.depth_far - motion.depth_near;
        ViewedTool& tool = view_->scene_.tools[step.tool];
        if (turns > few_turns && deep > 0.0) tool.lead = std::max(tool.lead, deep / turns);
    }
}

void RecordedView::Reader::finish(const session::RecordedRun& run, const std::string& folder, const std::string& why) {
    take_events(std::numeric_limits<std::uint64_t>::max());
    estimate_axes();
    RecordedView& view = *view_;
    view.scene_.zones = recorded_zones(run.summary);
    RecordedBone bone = recorded_bone(run, folder);
    view.surface_ = std::move(bone.surface);
    constexpr double smallest = 40e-3;  // [m]
    if (!view.moments_.empty()) {
        Vec3 middle{};
        for (const ViewedMoment& moment : view.moments_) middle = middle + moment.state.world_from_tool.position;
        middle = (1.0 / static_cast<double>(view.moments_.size())) * middle;
        view.scene_.region_middle = middle;
        view.scene_.region_radius = smallest;
    }
    view.scene_.time_limit = state_.time + Simulation::dt;
    view.scene_.note =
        text::printable("From the record alone: " + why + "; " + bone.words + "; the tool is a pointer of " +
                        std::to_string(std::lround(1e3 * pointer_length)) + " mm.");
    state_.is_over = true;
    view.moments_.push_back({state_, nullptr});
    for (ViewedMoment& moment : view.moments_) moment.surface = view.surface_;
    view.last_ = state_;
    view.result_ = viewed_result(run.summary, "");
    for (std::string& reason : view.result_.reasons) reason = text::printable(reason);
    for (ViewedResult::Deduction& deduction : view.result_.deductions) {
        deduction.words = text::printable(deduction.words);
        if (!std::isfinite(deduction.time)) deduction.time = -1.0;
    }
}

std::unique_ptr<RecordedView> RecordedView::read(const std::string& session, const std::string& why,
                                                 std::string& error) {
    std::unique_ptr<RecordedView> view(new RecordedView);
    Reader reader(*view);
    const auto run = session::read_run(session, error, false, &reader);
    if (!run) return nullptr;
    if (!reader.fault().empty())
        error = session + ": " + reader.fault() + ". Take an undamaged copy.";
    else if (view->rows_.empty())
        error = session + ": holds no ticks that can be shown.";
    if (!error.empty()) return nullptr;
    reader.finish(*run, std::filesystem::path(session).parent_path().string(), why);
    return view;
}

// ---- the viewer ---------------------------------------------------------------------------------------------------

std::optional<double> RecordedView::duration() const noexcept { return last_.time + Simulation::dt; }

bool RecordedView::take(ViewedState& state) noexcept {
    state = last_;
    return !std::exchange(is_taken_, true);
}

void RecordedView::take(std::vector<ViewedRow>& rows) {
    rows.insert(rows.end(), rows_.begin(), rows_.end());
    rows_ = {};
}

void RecordedView::take(std::vector<ViewedEvent>& events) {
    events.insert(events.end(), events_.begin(), events_.end());
    events_ = {};
}

void RecordedView::take(std::vector<ViewedMoment>& moments) {
    moments.insert(moments.end(), moments_.begin(), moments_.end());
    moments_ = {};
}

void RecordedView::take(std::vector<std::shared_ptr<const ViewedRadiograph>>& radiographs) {
    for (; radiographs_taken_ < radiographs_.size(); ++radiographs_taken_)
        radiographs.push_back(radiographs_[radiographs_taken_]);
}

std::shared_ptr<const ViewedRadiograph> RecordedView::radiograph() const {
    return radiographs_.empty() ? nullptr : radiographs_.back();
}

}  // namespace kerf::run
