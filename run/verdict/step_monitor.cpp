// SPDX-License-Identifier: Apache-2.0
#include "run/verdict/step_monitor.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "documents/solids.h"
#include "documents/turn_about.h"
#include "run/verdict/within_bound.h"

namespace kerf::run {

namespace {

Vec3 unit_or_none(Vec3 v) noexcept { return dot(v, v) > 1e-12 ? normalized(v) : Vec3{}; }

}  // namespace

Vec3 AxisFrame::off_plan() const noexcept {
    if (across != Vec3{}) return across;
    return medial != Vec3{} ? medial : rotate(quat_between({0, 0, 1}, along), {1, 0, 0});
}

Pose AxisFrame::pose_at(const documents::Waypoint& w) const noexcept {
    const Vec3 into_bone = w.is_across_surface && inwards != Vec3{} ? inwards : along;
    Vec3 from_entry = w.depth * into_bone + w.medial * medial + w.aside * aside() + w.off_plan * off_plan();
    Quat rotation = quat_between({0, 0, 1}, into_bone);
    if (across != Vec3{})
        rotation = documents::turn_about(into_bone, rotate(rotation, {0, 1, 0}),
                                         unit_or_none(across - dot(across, into_bone) * into_bone)) *
                   rotation;
    if (w.tilt != 0.0) rotation = rotation * quat_from_rotation_vector({0, 0, w.tilt});
    if (w.medial_angle != 0.0 || w.cranial_angle != 0.0) {
        constexpr Vec3 towards_the_head{0, 0, 1};
        const Quat turn = quat_from_rotation_vector(w.medial_angle * cross(along, medial) +
                                                    w.cranial_angle * unit_or_none(cross(along, towards_the_head)));
        from_entry = rotate(turn, from_entry);
        rotation = turn * rotation;
    }
    return {entry + from_entry, rotation};
}

AxisFrame axis_frame(const documents::LandmarkAxis& axis, double entry_along_axis, const documents::Anatomy& anatomy,
                     const documents::LandmarkPlane* plane) noexcept {
    AxisFrame frame;
    frame.along = normalized(axis.to - axis.from);
    frame.entry = axis.from + entry_along_axis * frame.along;
    for (const auto& point : anatomy.points)
        if (point.id == "midline") {
            // Perpendicular to the axis, towards the midline at the same depth.
            const Vec3 away = point.at - frame.entry;
            frame.medial = normalized(away - dot(away, frame.along) * frame.along);
        }
    if (plane != nullptr) frame.across = normalized(plane->normal - dot(plane->normal, frame.along) * frame.along);
    return frame;
}

double clearance(const ToolSolid& solid, const Pose& world_from_tool, const documents::Zone& zone,
                 Vec3* closest) noexcept {
    const auto& outline = solid.outline();
    double least = HUGE_VAL;
    for (std::size_t i = 0; i + 1 < outline.size(); ++i)
        for (int step = 0; step <= 4; ++step) {
            const double t = 0.25 * step;
            const double r = outline[i].radius + t * (outline[i + 1].radius - outline[i].radius);
            const double z = outline[i].z + t * (outline[i + 1].z - outline[i].z);
            for (const Vec3 in_tool : solid.around(r, z)) {
                const Vec3 at = world_from_tool * in_tool;
                const double distance = documents::distance_to_any(zone.solids, at);
                if (!(distance < least)) continue;
                least = distance;
                if (closest != nullptr) *closest = at;
            }
        }
    return least;
}

namespace {

/// Returns the distance of a value beyond its bound; negative within.
double excess_of(const documents::Bound& bound, double value) noexcept {
    return std::max(bound.at_least ? *bound.at_least - value : -HUGE_VAL,
                    bound.at_most ? value - *bound.at_most : -HUGE_VAL);
}

/// Adds a signal that a goal or limit names, once.
void add_signal(const documents::NamedSignal& signal, std::vector<SignalState>& signals) {
    if (signal.id.empty()) return;
    if (std::none_of(signals.begin(), signals.end(), [&](const SignalState& s) { return s.signal->id == signal.id; }))
        signals.push_back({.signal = &signal});
}

/// Returns the value of a signal; nothing if it is not finite.
std::optional<double> value_of(const documents::NamedSignal& signal, const Observation& now) noexcept {
    if (signal.index >= now.signals.size() || !std::isfinite(now.signals[signal.index])) return {};
    return now.signals[signal.index];
}

void take_signals(const Observation& now, StepState& state) noexcept {
    for (SignalState& s : state.signals)
        if (const auto value = value_of(*s.signal, now)) {
            s.least = s.is_seen ? std::min(s.least, *value) : *value;
            s.greatest = s.is_seen ? std::max(s.greatest, *value) : *value;
            s.last = *value;
            s.is_seen = true;
        }
    for (std::size_t g = 0; g < state.was_within_bound.size(); ++g) {
        const documents::Goal& goal = state.step->goals[g];
        if (goal.quantity != "signal") continue;
        if (const auto value = value_of(goal.signal, now); value && is_within(goal.bound, *value))
            state.was_within_bound[g] = true;
    }
}

/// Returns the pose of the world in the body `owner`.
Pose body_from_world(std::size_t owner, const Observation& now) noexcept {
    return owner < now.world_from_body.size() ? inverse(now.world_from_body[owner]) : identity_pose();
}

/// Returns the pose of the tool in the body `owner`.
Pose seen_from(std::size_t owner, const Observation& now) noexcept {
    if (owner >= now.world_from_body.size()) return now.world_from_tool;
    return inverse(now.world_from_body[owner]) * now.world_from_tool;
}

}  // namespace

void TipSpeed::show(Vec3 tip, bool is_in_bone, double dt) noexcept {
    moved_[next_] = is_in_bone && before_ ? tip - *before_ : Vec3{};
    next_ = (next_ + 1) % ticks;
    before_ = tip;
    Vec3 sum{};
    for (const Vec3 moved : moved_) sum = sum + moved;
    value_ = dt > 0.0 ? length(sum) / (static_cast<double>(ticks) * dt) : 0.0;
}

StepMonitor::StepMonitor(const documents::Procedure& procedure, const documents::Anatomy& anatomy,
                         std::vector<AxisFrame> frames)
    : anatomy_(&anatomy), measures_(&procedure.measures), frames_(std::move(frames)) {
    owners_.zone.assign(anatomy.zones.size(), 0);
    owners_.step.assign(procedure.steps.size(), 0);
    for (const auto& step : procedure.steps) {
        StepState state;
        state.step = &step;
        state.goal_done.assign(step.goals.size(), false);
        state.was_within_bound.assign(step.goals.size(), false);
        for (const auto& goal : step.goals) add_signal(goal.signal, state.signals);
        for (const auto& limit : step.limits) {
            state.limits.emplace_back();
            state.limits.back().limit = &limit;
            add_signal(limit.signal, state.signals);
        }
        steps_.push_back(std::move(state));
    }
}

void StepMonitor::observe(const Observation& now, const ToolSolid& cutting) {
    const double time = now.time;
    const bool is_running = now.is_running, is_resisted = now.is_resisted;
    const bool is_in_bone = is_running && is_resisted;
    news_.clear();
    if (current_ >= steps_.size()) return;
    StepState& state = steps_[current_];
    const AxisFrame& frame = frames_[current_];
    const Pose tool = seen_from(owners_.step[current_], now);
    if (!state.start) {
        state.start = time;
        state.bodies_before = bodies_parted_before(now);
    }

    if (const std::size_t owner = owners_.step[current_]; owner < now.world_from_body.size())
        state.moved = std::max(state.moved, length(now.world_from_body[owner] * frame.entry - frame.entry));
    const double depth = depth_ = frame.depth_of(tool.position);
    const double offset = length(tool.position - frame.entry - depth * frame.along);
    const bool is_first_bone = is_in_bone && !state.has_cut_bone();
    if (is_first_bone) {
        state.deepest = 0.0;
        state.advance.front = depth;
        news_.emplace_back("entered_bone", state.step->id);
    }
    if (is_resisted && !is_running) state.has_met_bone_still = true;
    if (is_in_bone) {
        state.deepest = std::max(state.deepest, depth);
        state.farthest_offset = std::max(state.farthest_offset, offset);
    }
    if (is_running && state.has_cut_bone())
        follow(now, depth, frame.depth_of(body_from_world(owners_.step[current_], now) * now.handle), time - before_,
               state);
    state.tip_speed.show(tool.position, is_in_bone, time - before_);
    before_ = time;
    state.removed = now.removed;
    state.has_held = state.has_held || (now.held >= 0 && now.held == static_cast<int>(owners_.step[current_]));
    take_signals(now, state);

    for (auto& limit : state.limits)
        if (const auto value = measured(limit, state, now, depth, cutting)) {
            const bool is_closer = limit.limit->quantity == "clearance" && (!limit.is_seen || *value < limit.worst);
            hold(limit, *value, time);
            if (is_closer) limit.closest = closest_to(limit, now, cutting);
        }

    std::size_t next_goal = 0;
    for (; next_goal < state.goal_done.size(); ++next_goal) {
        if (state.goal_done[next_goal]) continue;
        if (!is_reached(next_goal, state, now)) break;  // goals are reached in order
        state.goal_done[next_goal] = true;
        news_.emplace_back("goal_reached", state.step->id + ": " + state.step->goals[next_goal].name());
    }
    update_need_of_measures(state, next_goal, is_in_bone, state.is_released_at_end ? !is_running : depth < 0.0,
                            now.held);

    // The step ends when its goals are reached and the tool is outside the bone without a held body, or is released.
    const bool is_over = is_released_ || (depth < 0.0 && !state.is_released_at_end);
    if (state.has_reached_all() && is_over && now.held < 0) {
        is_released_ = false;
        state.end = time;
        state.reduction = reduction_of(*anatomy_, now.world_from_body);
        for (auto& limit : state.limits)
            if (const auto value =
                    measured_at_end(*limit.limit, *anatomy_, now.world_from_body, now.world_from_tool.position))
                hold(limit, *value, time);
        if (state.is_released_at_end) judge_left(state, time);
        news_.emplace_back("step_done", state.step->id);
        is_measure_due_ = needs_measures_ = false;
        ++current_;
    }
}

std::optional<double> StepState::value_of_goal(std::size_t goal) const noexcept {
    const documents::Goal& wanted = step->goals[goal];
    if (wanted.quantity == "moved") return moved;
    if (wanted.quantity == "removed_volume") return removed;
    if (wanted.quantity == "depth") return left_depth ? *left_depth : std::max(0.0, deepest);
    if (wanted.quantity != "signal") return {};
    for (const SignalState& signal : signals)
        if (signal.signal->id == wanted.signal.id && signal.is_seen) return left_depth ? signal.last : signal.greatest;
    return {};
}

void StepMonitor::judge_left(StepState& state, double time) {
    state.left_depth = depth_;
    for (std::size_t g = 0; g < state.goal_done.size(); ++g) {
        const documents::Goal& goal = state.step->goals[g];
        const std::optional<double> value = state.value_of_goal(g);
        if (!value || (goal.quantity != "depth" && goal.quantity != "signal")) continue;
        if (!is_within(goal.bound, *value)) lose_goal(state, g);
    }
    hold_state(state, time);
}

void StepMonitor::lose_goal(StepState& state, std::size_t goal) {
    state.goal_done[goal] = false;
    news_.emplace_back("goal_lost", state.step->id + ": " + state.step->goals[goal].name());
}

void StepMonitor::hold_state(StepState& state, double time) {
    for (LimitState& limit : state.limits) {
        if (limit.limit->quantity == "depth") hold(limit, depth_, time);
        if (limit.limit->quantity != "signal") continue;
        for (const SignalState& signal : state.signals)
            if (signal.signal->id == limit.limit->signal.id && signal.is_seen) hold(limit, signal.last, time);
    }
}

void StepMonitor::end_run(double time) {
    news_.clear();
    if (current_ >= steps_.size()) return;
    StepState& state = steps_[current_];
    if (!state.is_released_at_end || !state.has_cut_bone()) return;
    for (LimitState& limit : state.limits)
        if (limit.limit->quantity == "depth" && limit.limit->bound.at_most) hold(limit, depth_, time);
}

void StepMonitor::lose_goals(std::size_t step, std::string why) {
    StepState& state = steps_[step];
    state.goal_done.assign(state.goal_done.size(), false);
    state.lost_hold = std::move(why);
}

void StepMonitor::update_need_of_measures(const StepState& state, std::size_t next_goal, bool is_in_bone, bool is_out,
                                          int held) {
    is_measure_due_ = is_measure_due_ || is_in_bone || held >= 0;
    needs_measures_ = is_measure_due_ && is_out && held < 0 && next_goal < state.goal_done.size() &&
                      state.step->goals[next_goal].quantity == "measure";
    if (needs_measures_) is_measure_due_ = false;
}

void StepMonitor::show_measures(std::vector<documents::MeasureReading> measures) {
    needs_measures_ = false;
    if (current_ < steps_.size()) steps_[current_].measures = std::move(measures);
}

void StepMonitor::judge_measures(std::size_t step, std::vector<documents::MeasureReading> measures, double time) {
    news_.clear();
    StepState& state = steps_[step];
    state.measures = std::move(measures);
    for (std::size_t g = 0; g < state.goal_done.size(); ++g) {
        const documents::Goal& goal = state.step->goals[g];
        const documents::MeasureReading* reading =
            goal.quantity == "measure" ? reading_of(goal.measure, state) : nullptr;
        if (reading == nullptr || (reading->value && is_within(goal.bound, *reading->value))) continue;
        lose_goal(state, g);
    }
    for (auto& limit : state.limits) {
        if (limit.limit->quantity != "measure") continue;
        const documents::MeasureReading* reading = reading_of(limit.limit->measure, state);
        if (reading != nullptr && reading->value) hold(limit, *reading->value, time);
    }
}

const documents::MeasureReading* StepMonitor::reading_of(const std::string& measure,
                                                         const StepState& state) const noexcept {
    for (std::size_t m = 0; m < measures_->size() && m < state.measures.size(); ++m)
        if ((*measures_)[m].id == measure) return &state.measures[m];
    return nullptr;
}

std::optional<double> StepMonitor::measured(const LimitState& limit, const StepState& state, const Observation& now,
                                            double depth, const ToolSolid& cutting) const {
    const documents::Limit& asked = *limit.limit;
    const std::string& quantity = asked.quantity;
    // A stuck screw is not running, but its torque counts.
    if (quantity == "torque") return std::abs(now.torque);
    if (quantity == "lateral_force") return now.lateral_force;
    if (quantity == "removed_volume") return now.removed;
    if (quantity == "duration") return now.time - *state.start;
    if (quantity == "signal") {
        const auto value = value_of(limit.limit->signal, now);
        const std::optional<double>& at_least = limit.limit->bound.at_least;
        // What an implant must keep counts as it is left: it begins at nothing.
        const bool is_not_yet_there = value && state.is_released_at_end && at_least && *value < *at_least;
        return is_not_yet_there ? std::nullopt : value;
    }
    if (quantity == "depth" && state.is_released_at_end) return {};  // as it is left
    if (!now.is_running) return {};                                  // a still tool does no harm
    if (asked.is_of_wall() || asked.is_of_hole() || asked.is_of_places() || quantity == "measure" ||
        quantity == "damage")
        return {};  // judged at the end of the step
    if (quantity == "clearance") return clearance_to(limit, now, cutting);
    if (quantity == "thrust") return now.thrust;
    if (quantity == "plunge") return state.advance.plunge;
    if (quantity == "time_in_air") return state.advance.in_air;
    if (quantity == "speed") return now.is_resisted ? std::optional(state.tip_speed.value()) : std::nullopt;
    // Outside of the bone there is no hole that could be too deep.
    return state.has_cut_bone() ? std::optional(depth) : std::nullopt;
}

std::optional<double> StepMonitor::clearance_to(const LimitState& limit, const Observation& now,
                                                const ToolSolid& cutting) const {
    const auto zone = std::find_if(anatomy_->zones.begin(), anatomy_->zones.end(),
                                   [&](const documents::Zone& z) { return z.id == limit.limit->zone; });
    if (zone == anatomy_->zones.end()) return {};
    const Pose seen = seen_from(owners_.zone[static_cast<std::size_t>(zone - anatomy_->zones.begin())], now);
    // Distances are 1-Lipschitz: far from the zone, the tip's distance shows that the minimum cannot change.
    const double reach = cutting.tip_z() - cutting.end_z() + cutting.largest_radius();
    if (limit.is_seen && documents::distance_to_any(zone->solids, seen.position) - reach > limit.worst) return {};
    return clearance(cutting, seen, *zone);
}

ClosestPoint StepMonitor::closest_to(const LimitState& limit, const Observation& now, const ToolSolid& cutting) const {
    const auto zone = std::find_if(anatomy_->zones.begin(), anatomy_->zones.end(),
                                   [&](const documents::Zone& z) { return z.id == limit.limit->zone; });
    const Pose seen = seen_from(owners_.zone[static_cast<std::size_t>(zone - anatomy_->zones.begin())], now);
    ClosestPoint closest{.time = now.time};
    static_cast<void>(clearance(cutting, seen, *zone, &closest.at));
    return closest;
}

std::size_t StepMonitor::bodies_parted_before(const Observation& now) const noexcept {
    const std::size_t in_scene = anatomy_->fracture ? 2 : 1;
    const bool is_another = std::any_of(steps_.data(), steps_.data() + current_, [](const StepState& earlier) {
        const auto& goals = earlier.step->goals;
        return std::any_of(goals.begin(), goals.end(),
                           [](const documents::Goal& goal) { return goal.quantity == "separated"; });
    });
    return is_another ? std::max(in_scene, now.world_from_body.size()) : in_scene;
}

bool StepMonitor::is_reached(std::size_t index, const StepState& state, const Observation& now) const noexcept {
    const documents::Goal& goal = state.step->goals[index];
    if (goal.quantity == "signal") return state.was_within_bound[index];
    if (goal.quantity == "measure") {
        const documents::MeasureReading* reading = reading_of(goal.measure, state);
        return reading != nullptr && reading->value && is_within(goal.bound, *reading->value);
    }
    if (goal.quantity == "removed_volume") return is_within(goal.bound, state.removed);
    if (goal.quantity == "entry") return state.has_cut_bone();
    if (goal.quantity == "separated") return now.world_from_body.size() > state.bodies_before;
    if (goal.quantity == "held") return now.held == static_cast<int>(owners_.step[current_]);
    if (goal.quantity == "moved") return state.moved >= goal.bound.at_least.value_or(0.0);
    return state.has_cut_bone() && is_within(goal.bound, state.deepest);
}

void StepMonitor::judge_cut(std::size_t step, const std::optional<bone::CutWall>& wall, double removed, double time) {
    news_.clear();
    StepState& state = steps_[step];
    state.wall = wall;
    state.removed = removed;
    for (auto& limit : state.limits) {
        const std::string& quantity = limit.limit->quantity;
        if (quantity == "removed_volume") hold(limit, removed, time);
        if (!wall) continue;
        if (quantity == "plane_angle") hold(limit, wall->angle, time);
        if (quantity == "plane_offset") hold(limit, wall->offset, time);
        if (quantity == "flatness") hold(limit, wall->flatness, time);
    }
}

void StepMonitor::judge_hole(std::size_t step, HoleResult drilled, double time) {
    news_.clear();
    StepState& state = steps_[step];
    for (auto& limit : state.limits) {
        if (!drilled.hole) break;
        const bone::DrilledHole& hole = *drilled.hole;
        const std::string& quantity = limit.limit->quantity;
        if (quantity == "hole_angle" && hole.angle) hold(limit, *hole.angle, time);
        if (quantity == "entry_offset" && hole.entry_offset) hold(limit, *hole.entry_offset, time);
        if (quantity == "narrowest_offset" && hole.narrowest_offset) hold(limit, *hole.narrowest_offset, time);
        if (quantity == "end_offset") hold(limit, hole.end_offset, time);
        if (quantity == "excess_removal" && hole.ideal > 0.0) hold(limit, hole.drilled / hole.ideal - 1.0, time);
        for (const auto& [diameter, breach] : drilled.breaches)
            if (quantity == "breach" && diameter == limit.limit->diameter) hold(limit, breach.worst(), time);
    }
    state.drilled = std::move(drilled);
}

std::string StepMonitor::release() {
    if (current_ >= steps_.size() || !steps_[current_].has_reached_all()) return "a goal of the step is not reached";
    if (depth_ < 0.0) return "the implant is out of the bone";
    is_released_ = true;
    return {};
}

void StepMonitor::report(const std::string& event, double time) {
    news_.clear();
    if (current_ >= steps_.size()) return;
    for (auto& limit : steps_[current_].limits) {
        if (limit.limit->event != event) continue;
        limit.is_seen = true;
        limit.worst += 1.0;
        if (limit.broken_at) continue;
        limit.broken_at = time;
        news_.emplace_back("limit_broken", limit.limit->name());
    }
}

// The tip is at its front until it retracts by 0.1 mm. At 0.5 mm below the surface it is inside bone. If it passes a
// face while it retracts, the face is its own entry.
void StepMonitor::follow(const Observation& now, double depth, double hand, double dt, StepState& state) {
    constexpr double give = 0.1e-3, well_inside = 0.5e-3;
    TipProgress& advance = state.advance;
    const bool is_at_front = depth >= advance.front - give;
    advance.has_met_bone = advance.has_met_bone || now.is_bone_ahead;
    if (is_at_front && advance.has_met_bone && !now.is_bone_ahead) {
        advance.in_air += dt;
        advance.depth_in_air += std::max(0.0, depth - advance.front);
    }
    if (now.tip_inside > well_inside) {
        advance.is_inside = true;
        advance.left_at.reset();
    } else if (now.tip_inside <= 0.0 && advance.is_inside) {
        advance.is_inside = false;
        if (is_at_front) {
            advance.left_at = depth;
            advance.hand_left_at = hand;
        }
    }
    if (advance.left_at) {
        advance.plunge = std::max(advance.plunge, depth - *advance.left_at);
        advance.hand_plunge = std::max(advance.hand_plunge, hand - *advance.hand_left_at);
    }
    advance.front = std::max(advance.front, depth);
}

void StepMonitor::hold(LimitState& limit, double value, double time) {
    const documents::Bound& bound = limit.limit->bound;
    const bool is_broken = (bound.at_least && value < *bound.at_least) || (bound.at_most && value > *bound.at_most);
    const bool is_worse = bound.at_least && bound.at_most ? excess_of(bound, value) > excess_of(bound, limit.worst)
                          : bound.at_least                ? value < limit.worst
                                                          : value > limit.worst;
    if (!limit.is_seen || is_worse) limit.worst = value;
    limit.is_seen = true;
    if (!is_broken || limit.broken_at) return;
    limit.broken_at = time;
    news_.emplace_back(limit.limit->zone.empty() ? "limit_broken" : "zone_entered", limit.limit->name());
}

}  // namespace kerf::run
