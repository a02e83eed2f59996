// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/loop/haptic_loop.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace kerf {

namespace {

constexpr double fastest = 1.0;     // [m/s] maximum speed of a tool that bone resists
constexpr double skidding = 10e-3;  // [m/s] sideways velocity of the tip relative to the hand that is a skid [assumed]
constexpr int skidding_parts = 4;   // of a tick in a skid: edges catch and let go within 3 ms

bool is_resisted_by(const Motion& motion, std::uint32_t channels) noexcept {
    return std::any_of(motion.lambda.begin(), motion.lambda.begin() + channels,
                       [](double lambda) { return lambda > 0.0; });
}

}  // namespace

HapticLoop::HapticLoop(const Body& body, ToolSetup setup, ToolOutline outline, const CouplingGains& gains,
                       const Pose& start, double period)
    : HapticLoop(body, std::vector<Tool>{{std::move(setup), std::move(outline)}}, gains, start, period) {}

HapticLoop::HapticLoop(const Body& body, std::vector<Tool> tools, const CouplingGains& gains, const Pose& start,
                       double period)
    : period_(period),
      spacing_(body.grid().spacing),
      world_from_tool_(start),
      tools_(std::move(tools)),
      bodies_(body, outline()),
      hand_(gains, outline().handling, start) {
    start_tool();
}

HapticLoop::~HapticLoop() = default;

void HapticLoop::take_tool(std::size_t tool, double back) {
    world_from_tool_ = world_from_tool_ * Pose{{0, 0, -back}, {1, 0, 0, 0}};
    bodies_.flush();
    tools_.take(tool);
    bodies_.take_tool(now());
    last_rate_ = Vec6{};
    following_.forget();
    hand_.take_tool(outline().handling, world_from_tool_);
    start_tool();
}

void HapticLoop::take(LoopChange& change) {
    if (change.guide) lead(*change.guide);
    if (change.offer.needs_closed_stretches()) close_stretches();
    if (change.offer.is_any()) static_cast<void>(take(change.offer));
    if (change.removes_held) remove_held();
    if (change.held_points) set_held_points(*change.held_points);
    if (change.tool) {
        close_stretches();
        if (change.committed.is_any()) static_cast<void>(take(change.committed));
        take_tool(*change.tool, change.back);
    }
}

/// Starts the law of the tool in hand and moves the tool out of bone.
void HapticLoop::start_tool() {
    ledger_.restart();
    tools_.begin(bodies_.view().query(), period_, tick_);
    if (const double back = bodies_.distance_out_of_bone(now()); back > 0.0) {
        world_from_tool_ = world_from_tool_ * Pose{{0, 0, -back}, {1, 0, 0, 0}};
        hand_.relax(world_from_tool_);
        reported_.is_drawn_back = true;
    }
    bodies_.restart_stretches(now());
}

// ---- the tick -----------------------------------------------------------------------------------------------------

TickResult HapticLoop::tick(const DeviceSample& sample) noexcept {
    TickResult result = begin_tick();
    if (std::exchange(reported_.is_drawn_back, false)) result.add_event("haptics.started_in_bone");
    const bool is_steady = read_hand(sample);
    const bool is_moving = is_steady && !hand_.is_gate_closed();
    result.is_quarantined = !(is_moving ? move(result) : evaluate(period_));
    if (!is_moving || result.is_quarantined) rest(result);
    hand_.gate(is_steady, world_from_tool_, period_, result);
    add_contact_events(result);
    hand_.command(world_from_tool_, period_, result);
    end_tick(result);
    return result;
}

TickResult HapticLoop::tick_direct(const DeviceSample& sample) noexcept {
    TickResult result = begin_tick();
    hand_.read_direct(sample, period_);
    const Pose tool_from_next = inverse(world_from_tool_) * hand_.pose();
    result.rate = make_vec6((1.0 / period_) * tool_from_next.position,
                            (1.0 / period_) * small_rotation_vector(tool_from_next.rotation));
    result.is_quarantined = !evaluate(period_);

    const EvaluatedLaw& law = tools_.law();
    double lambda[max_balance_channels] = {};
    Vec6 following = result.is_quarantined ? Vec6{} : law.wrench, bone{};
    for (std::uint32_t c = 0; c < law.count; ++c) {
        const kerf_channel& channel = law.channel[c];
        lambda[c] = channel_force(channel, dot(direction(channel), result.rate), period_).lambda;
        for (std::size_t i = 0; i < 6; ++i) {
            following[i] += channel.follow[i] * lambda[c];
            bone[i] -= channel.d[i] * lambda[c];
        }
    }
    add_scaled(following, 1.0, bone);
    result.add_bone_wrench(bone, 1.0, world_from_tool_.rotation);
    result.power_hand = -dot(bone, result.rate);
    hand_.command_direct(period_, result);
    if (!result.is_quarantined) result.is_quarantined = !apply({result.rate, lambda, following, period_}, result);
    end_tick(result);
    return result;
}

TickResult HapticLoop::begin_tick() noexcept {
    bodies_.begin_tick();
    return {};
}

bool HapticLoop::read_hand(const DeviceSample& sample) noexcept {
    return hand_.read(sample, world_from_tool_, kinetic_energy(outline().inertia, last_rate_), period_);
}

void HapticLoop::end_tick(TickResult& result) noexcept {
    result.world_from_tool = world_from_tool_;
    ++tick_;
}

// ---- finding the motion -------------------------------------------------------------------------------------------

bool HapticLoop::evaluate(double dt_of_step) noexcept {
    return tools_.evaluate({bodies_.view(), bodies_.all(), bodies_.held(), guide_, outline(), world_from_tool_},
                           dt_of_step, tick_);
}

/// Evaluates the law and solves for the motion of one step. Returns false if the law is unsound or the solve fails.
bool HapticLoop::find_motion(const Pose& world_from_handle, Step& step) noexcept {
    if (!evaluate(step.dt)) return false;
    Balance& balance = step.balance;
    hand_.couple(world_from_handle, world_from_tool_, step.dt, balance);
    balance.channels = tools_.law().channels();
    balance.following = following_.wrench(balance, tools_.law().wrench);
    balance.inertia = outline().inertia;
    balance.previous_rate = last_rate_;
    step.motion = solve_from(balance, last_rate_);
    if (step.motion.has_converged) return true;
    return tools_.reject({.what = LawFault::What::solve, .value = step.motion.residual});
}

/// Finds and applies the motion of a tick, in parts if it is fast. Returns false if a law is unsound or a solve fails.
bool HapticLoop::move(TickResult& result) noexcept {
    Step step{.dt = period_, .balance = {}, .motion = {}};
    if (!find_motion(hand_.pose(), step)) return false;
    const double travel = travel_in(step);
    const bool is_fast = travel > half_voxel() && bodies_.is_in_reach(now(), clamp_voxels * spacing_ + travel);
    result.parts = choose_parts(step, travel, is_fast, result);
    if (result.parts > 1) {
        step.dt = period_ / result.parts;
        if (!find_motion(hand_.pose_after(1, result.parts), step)) return false;
    }
    for (int part = 1;; ++part) {
        if (is_fast) limit_speed(step);
        report(step, 1.0 / result.parts, result);
        following_.update(step.balance, step.motion);
        hand_.credit_motor(step.balance, step.motion, step.dt);
        if (!apply({step.motion.rate, step.motion.lambda.data(), step.balance.following, step.dt}, result))
            return false;
        if (part == result.parts) break;
        if (!find_motion(hand_.pose_after(part + 1, result.parts), step)) return false;
    }
    hand_.slide(world_from_tool_);
    if (tools_.law().count == 0) hand_.realign(period_);
    if (unresisted_.check(step.motion, tools_.law(), bodies_, now(), spacing_)) result.add_event("haptics.unresisted");
    return true;
}

/// Returns the largest distance that a point of the tool or of the held body moves in a step [m].
double HapticLoop::travel_in(const Step& step) noexcept {
    const Pose next = advanced(world_from_tool_, step.motion.rate, step.dt);
    const double of_tool = largest_motion(outline().whole, world_from_tool_, next);
    const HeldBody& held = bodies_.held();
    return held.is_any() ? std::max(of_tool, held.largest_motion(world_from_tool_, next)) : of_tool;
}

int HapticLoop::choose_parts(const Step& step, double travel, bool is_fast, TickResult& result) noexcept {
    const bool is_behind = bodies_.is_behind();
    if (is_fast && is_behind && !std::exchange(reported_.is_held_back, true)) result.add_event("haptics.held_back");
    if (is_behind) return 1;
    reported_.is_held_back = false;
    const int parts =
        is_fast ? static_cast<int>(std::min(std::ceil(travel / half_voxel()), static_cast<double>(max_parts))) : 1;
    return is_skidding(step) ? std::max(parts, skidding_parts) : parts;
}

/// Returns whether the law resists and the tip's velocity across the shaft differs from the hand's by more than
/// `skidding`.
bool HapticLoop::is_skidding(const Step& step) const noexcept {
    if (!is_resisted_by(step.motion, tools_.law().law_count)) return false;
    const Balance& balance = step.balance;
    const Vec3 hand = balance.hand_velocity - cross(balance.hand_turn, balance.centre);
    const Vec3 slip = linear(step.motion.rate) - hand;
    return slip.x * slip.x + slip.y * slip.y > skidding * skidding;
}

/// Scales a step's rate so that no point moves farther than half a voxel, nor faster than `fastest` if resisted.
/// Recomputes the forces for that rate.
void HapticLoop::limit_speed(Step& step) noexcept {
    const double limit =
        is_resisted_by(step.motion, tools_.law().count) ? std::min(half_voxel(), fastest * step.dt) : half_voxel();
    const double wanted = travel_in(step);
    if (!(wanted > limit)) return;
    for (double& component : step.motion.rate) component *= limit / wanted;
    step.motion = at_rate(step.balance, step.motion.rate);
}

// ---- applying it --------------------------------------------------------------------------------------------------

/// Adds the forces of one step to the result. `weight` is the step's fraction of the tick.
void HapticLoop::report(const Step& step, double weight, TickResult& result) noexcept {
    result.iterations = std::max(result.iterations, step.motion.iterations);
    Vec6 bone = step.balance.following;
    const EvaluatedLaw& law = tools_.law();
    for (std::uint32_t c = 0; c < law.count; ++c)
        for (std::size_t i = 0; i < 6; ++i) bone[i] -= law.channel[c].d[i] * step.motion.lambda[c];
    result.add_bone_wrench(bone, weight, world_from_tool_.rotation);
    hand_.add_wrenches(step.balance, step.motion, weight, world_from_tool_, result);
    add_scaled(step.motion.rate, weight, result.rate);
}

/// Leaves the tool at its pose and sets the forces of the result to zero. A sound law is still committed, at rate zero,
/// so that its time passes.
void HapticLoop::rest(TickResult& result) noexcept {
    last_rate_ = {};
    following_.forget();
    result.bone_on_tool = result.coupled_on_hand = result.limited_on_hand = Vec6{};
    result.thrust = result.torque = result.power_hand = 0.0;
    if (result.is_quarantined) return;
    constexpr double no_force[max_balance_channels] = {};
    result.is_quarantined = !apply({Vec6{}, no_force, Vec6{}, period_}, result);
}

/// Lets the plugin update its state, moves the tool and removes the bone that it cut. Returns false, and does neither,
/// if the law's `commit` is unsound.
bool HapticLoop::apply(const AppliedMotion& applied, TickResult& result) noexcept {
    last_rate_ = applied.rate;
    const CommittedLaw committed = tools_.commit(applied, bodies_.view().query(), tick_);
    if (!committed.is_sound) return false;
    if (ledger_.add(tools_.law(), applied, tools_.is_driven())) result.add_event("haptics.law_made_energy");
    if (committed.has_thread && !bodies_.keep(committed.thread) && !std::exchange(reported_.has_full_threads, true))
        result.add_event("haptics.threads_full");

    const EvaluatedLaw& law = tools_.law();
    if (law.metal_channel >= 0 && applied.lambda[law.metal_channel] > 0.0) result.is_at_metal = true;
    bool is_at_front = false;  // an edge met uncut bone in this step
    for (std::uint32_t c = 0; c < law.law_count; ++c) {
        const kerf_channel& channel = law.channel[c];
        const double rate_along = dot(direction(channel), applied.rate);
        if (channel.kind == KERF_CUT && applied.lambda[c] > 0.0 && rate_along * applied.dt > channel.gap)
            is_at_front = true;
    }

    world_from_tool_ = advanced(world_from_tool_, applied.rate, applied.dt);
    bool is_cutting = false;
    for (std::uint32_t a = 0; a < committed.action_count; ++a) {
        const kerf_action& action = committed.action[a];
        if (action.kind == KERF_ACTION_CUT && action.value == KERF_CUT_REGION) is_cutting = true;
        apply_action(action, result);
    }
    if (is_cutting) result.is_cutting = true;
    bodies_.cut(now(), is_cutting, is_at_front);
    return true;
}

void HapticLoop::apply_action(const kerf_action& action, TickResult& result) noexcept {
    const kerf_force& law = *setup().force->force;
    if (action.kind == KERF_ACTION_CUT && action.value == KERF_CUT_THREAD) result.is_stripping = outline().has_thread();
    if (action.kind == KERF_ACTION_EVENT && action.value < law.event_count)
        result.add_event(law.events[action.value].id);
    if (action.kind == KERF_ACTION_RELEASE) bodies_.held().release();
    if (action.kind == KERF_ACTION_HOLD && !bodies_.hold(action.value, world_from_tool_))
        result.add_event("haptics.bone_is_whole");
}

void HapticLoop::add_contact_events(TickResult& result) noexcept {
    const EvaluatedLaw& law = tools_.law();
    if (law.is_at_region_wall && !std::exchange(reported_.has_left_region, true))
        result.add_event("haptics.left_region");
    if (result.is_at_metal && !std::exchange(reported_.has_met_metal, true)) result.add_event("haptics.met_metal");
    if (law.metal_channel < 0) reported_.has_met_metal = false;  // the tool is farther than 0.3 mm from metal
}

}  // namespace kerf
