// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/loop/haptic_loop.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <utility>

#include "core/field/cut/reach.h"
#include "core/haptics/loop/free_pose.h"
#include "core/plugin/plugin_call.h"
#include "kerf/assert.hpp"

namespace kerf {

namespace {

constexpr double fastest = 1.0;        // [m/s] of a tool that bone resists (B9)
constexpr double skidding = 10e-3;     // [m/s] of a tip in bone across its shaft, faster than the hand [assumed]
constexpr double straightening = 0.3;  // [s] in which a hand takes a new tool straight, in air [assumed]
constexpr int skidding_parts = 4;      // its edges catch and let go within 3 ms

// What is taken for a part of the tool that goes through bone unresisted [assumed]
constexpr std::uint64_t unresisted_interval = 16;                  // ticks from look to look
constexpr double least_ring_gap = 1e-3, most_rings = 16.0;         // [m], of what is looked at
constexpr double unresisted_reach = 3e-3, unresisted_slant = 0.2;  // [m], [–] of a channel that acts there
constexpr std::size_t closed_room =
    (2 * 16 + 3) * most_bodies;  // records of a tick at their most, of a turn and a subtraction

void add(const Vec6& v, double share, Vec6& sum) noexcept {
    for (std::size_t i = 0; i < 6; ++i) sum[i] += share * v[i];
}

bool is_resisted_by(const Motion& motion, std::uint32_t channels) noexcept {
    return std::any_of(motion.lambda.begin(), motion.lambda.begin() + channels,
                       [](double lambda) { return lambda > 0.0; });
}

Vec6 turned(Quat q, const Vec6& v) noexcept { return make_vec6(rotate(q, linear(v)), rotate(q, angular(v))); }

}  // namespace

HapticLoop::HapticLoop(const Body& body, ToolSetup setup, ToolOutline outline, const CouplingGains& gains,
                       const Pose& start, double period)
    : HapticLoop(body, std::vector<Tool>{{std::move(setup), std::move(outline)}}, gains, start, period) {}

HapticLoop::HapticLoop(const Body& body, std::vector<Tool> tools, const CouplingGains& gains, const Pose& start,
                       double period)
    : period_(period),
      spacing_(body.grid().spacing),
      tools_(std::move(tools)),
      view_(body, threads_),
      world_from_tool_(start),
      hand_(start),
      coupling_(gains, outline().handling),
      guard_(port_of_forces(gains), port_of_shaft(coupling_)) {
    bodies_.reserve(most_bodies);
    bodies_.push_back(
        std::make_unique<LiveBody>(std::uint16_t{0}, body, CutField(body, live_reserve), outline().cutting));
    closed_.reserve(closed_room);
    std::size_t size = 0;
    for (const Tool& tool : tools_)
        size = std::max<std::size_t>(size, tool.setup.force->force->state_size + tool.setup.force->force->state_align);
    state_storage_ = std::make_unique<std::byte[]>(size);
    resist_times_.resize(tools_.size());
    begin_with_tool();
}

void HapticLoop::begin_with_tool() {
    const kerf_force& force = *setup().force->force;
    void* aligned = state_storage_.get();
    std::size_t space = force.state_size + force.state_align;
    state_ = static_cast<std::byte*>(std::align(force.state_align, force.state_size, aligned, space));
    solid_ = outline().solid();
    std::fill(std::begin(signals_), std::end(signals_), 0.0);
    drives_.fill(0.0);
    std::copy(setup().drives.begin(), setup().drives.end(), drives_.begin());
    const kerf_tick_in in = tick_in(period_);
    call_begin(*setup().force, in, state_);
    double back = 0.0;
    for (const auto& body : bodies_)
        if (body->is_present)
            back = std::max(
                back, way_out_of_bone(*body->bone, outline().whole, body->body_from(world_from_tool_)).value_or(0.0));
    if (back > 0.0) {
        world_from_tool_ = world_from_tool_ * Pose{{0, 0, -back}, {1, 0, 0, 0}};
        coupling_.let_go(hand_.pose(), world_from_tool_);
        is_drawn_back_ = true;
    }
    for (const auto& body : bodies_) body->tracker.restart(body->body_from(world_from_tool_));
    look_around();
}

HapticLoop::~HapticLoop() = default;

PassivityGuard::Port HapticLoop::port_of_forces(const CouplingGains& gains) noexcept {
    return {gains.spare_damping, gains.stiffness * gains.resolution * gains.resolution, gains.resolution};
}

PassivityGuard::Port HapticLoop::port_of_shaft(const Coupling& coupling) noexcept {
    const CouplingGains& gains = coupling.gains();
    const double count = gains.shaft.resolution;
    return {gains.shaft.damping, gains.force_scale * coupling.spring().turn_stiffness.along * count * count, count};
}

std::vector<const ToolSolid*> HapticLoop::cutting_solids() const {
    std::vector<const ToolSolid*> solids;
    for (std::size_t number = 0; number < 2 * tools_.size(); ++number) solids.push_back(&solid(number));
    return solids;
}

// ---- asking and solving -------------------------------------------------------------------------------------------

kerf_tick_in HapticLoop::tick_in(double step) const noexcept {
    kerf_tick_in in = tick_in_of(setup(), view_.query(), step);
    in.tick = tick_;
    in.drive = drives_.data();
    in.outline = &solid_;
    return in;
}

bool HapticLoop::ask(double step) noexcept {
    const LawFault fault =
        evaluate_law(*setup().force, tick_in(step), state_,
                     {view_, bodies_, held_, guide_, outline(), world_from_tool_}, resist_times_[tool_], law_);
    return fault.what == LawFault::What::none || release_because(fault);
}

bool HapticLoop::release_because(LawFault fault) noexcept {
    fault.law = setup().force;
    law_fault_ = fault;
    return false;
}

std::vector<std::string> HapticLoop::laws_over_budget() const {
    std::vector<std::string> lines;
    for (std::size_t t = 0; t < tools_.size(); ++t)
        if (std::string line = over_budget(resist_times_[t], *tools_[t].setup.force, clock_scale_); !line.empty())
            lines.push_back(std::move(line));
    return lines;
}

bool HapticLoop::find_motion(const Pose& handle, double step, Balance& balance, Motion& motion) noexcept {
    if (!ask(step)) return false;
    coupling_.hold(handle, hand_.rate(), world_from_tool_, step, balance);
    balance.channels = law_.channels();
    balance.following = following_.wrench(balance, law_.wrench);
    balance.inertia = outline().inertia;
    balance.previous_rate = last_rate_;
    motion = solve_from(balance, last_rate_);
    if (motion.has_converged) return true;
    return release_because({.what = LawFault::What::solve, .value = motion.residual});
}

// ---- the tick -----------------------------------------------------------------------------------------------------

TickResult HapticLoop::tick(const DeviceSample& sample) noexcept {
    TickResult result;
    closed_.clear();
    bricks_left_ = CutTracker::most_bricks;
    if (std::exchange(is_drawn_back_, false)) result.add_event("haptics.started_in_bone");
    const Pose last_handle = hand_.pose();
    const bool is_steady = hand_.take(sample, period_);
    if (is_steady) {
        const Vec3 grip = coupling_.grip();
        const Quat turn = conjugate(last_handle.rotation) * hand_.pose().rotation;
        const bool has_shaft = coupling_.gains().shaft.is_driven();
        const Vec3 turned_by = coupling_.gains().has_torque || has_shaft
                                   ? rotate(last_handle.rotation, small_rotation_vector(turn))
                                   : Vec3{};
        guard_.observe(commanded_, make_vec6(hand_.pose() * grip - last_handle * grip, turned_by), supplied_,
                       coupling_.stored(hand_.pose(), world_from_tool_) +
                           coupling_.gains().force_scale * kinetic_energy(outline().inertia, last_rate_),
                       has_shaft ? small_rotation_vector(turn).z : 0.0);
    }
    supplied_ = 0.0;

    const bool was_barred = gate_.is_barred();
    if (was_barred || !is_steady) {
        result.is_quarantined = !ask(period_);
        rest(result);
    } else {
        result.is_quarantined = !move(last_handle, result);
        if (result.is_quarantined) rest(result);
    }
    gate_.step(is_steady && !result.is_quarantined, period_);
    result.is_barred = gate_.is_barred();
    if (result.is_barred && !was_barred) {
        before_fault_ = commanded_;
        result.add_event(is_steady ? "haptics.quarantined" : "haptics.hand_lost");
    }
    if (was_barred && !result.is_barred) {
        guard_.restart();
        result.add_event("haptics.anchored_again");
    }
    if (was_barred || result.is_barred) coupling_.let_go(hand_.pose(), world_from_tool_);

    if (law_.is_at_region_wall && !has_left_region_) {
        has_left_region_ = true;
        result.add_event("haptics.left_region");
    }
    if (result.is_at_metal && !std::exchange(has_met_metal_, true)) result.add_event("haptics.met_metal");
    if (law_.metal_channel < 0) has_met_metal_ = false;  // well away from it
    command(result);
    if (!result.is_barred)
        coupling_.allow(gate_.share(coupling_.gains().force_limit, length(linear(commanded_)), period_), gate_.gain());
    result.is_coming_back = gate_.state() == ForceGate::State::opening;
    result.world_from_tool = world_from_tool_;
    ++tick_;
    return result;
}

bool HapticLoop::move(const Pose& last_handle, TickResult& result) noexcept {
    Balance balance;
    Motion motion;
    if (!find_motion(hand_.pose(), period_, balance, motion)) return false;

    const double half_voxel = 0.5 * spacing_;
    const auto motion_in = [&](double step) {
        const Pose next = advanced(world_from_tool_, motion.rate, step);
        const double of_tool = largest_motion(outline().whole, world_from_tool_, next);
        return held_.is_any() ? std::max(of_tool, held_.largest_motion(world_from_tool_, next)) : of_tool;
    };
    const auto handle_in = [&](int part) {
        return part == result.parts ? hand_.pose()
                                    : between(last_handle, hand_.pose(), static_cast<double>(part) / result.parts);
    };
    const double moved = motion_in(period_);
    const bool is_fast = moved > half_voxel && is_bone_in_reach(clamp_voxels * spacing_ + moved);
    const bool is_behind =
        std::any_of(bodies_.begin(), bodies_.end(), [](const auto& body) { return body->tracker.is_behind(); });
    if (is_fast && is_behind && !std::exchange(is_held_back_, true)) result.add_event("haptics.held_back");
    if (!is_behind) is_held_back_ = false;
    double step = period_;
    if (is_fast && !is_behind)
        result.parts = static_cast<int>(std::min(std::ceil(moved / half_voxel), static_cast<double>(most_parts)));
    if (!is_behind && is_skidding(balance, motion)) result.parts = std::max(result.parts, skidding_parts);
    if (result.parts > 1) {
        step = period_ / result.parts;
        if (!find_motion(handle_in(1), step, balance, motion)) return false;
    }
    for (int part = 1;; ++part) {
        if (is_fast) {
            const double most = is_resisted_by(motion, law_.count) ? std::min(half_voxel, fastest * step) : half_voxel;
            const double wanted = motion_in(step);
            if (wanted > most) {
                for (double& component : motion.rate) component *= most / wanted;
                motion = at_rate(balance, motion.rate);
            }
        }
        result.iterations = std::max(result.iterations, motion.iterations);
        report(balance, motion, 1.0 / result.parts, result);
        following_.update(balance, motion);
        supplied_ += coupling_.gains().force_scale * std::max(0.0, dot(balance.following, motion.rate)) * step;
        commit(motion.rate, motion.lambda.data(), balance.following, step, result);
        if (part == result.parts) break;
        if (!find_motion(handle_in(part + 1), step, balance, motion)) return false;
    }
    coupling_.slide(hand_.pose(), world_from_tool_);
    if (is_new_tool_ && law_.count == 0) is_new_tool_ = coupling_.straighten(std::min(1.0, period_ / straightening));
    if (tick_ % unresisted_interval == 0) look_for_unresisted(motion, result);
    return true;
}

/// Whether the tip slips sideways on bone by itself, faster than the hand goes.
bool HapticLoop::is_skidding(const Balance& balance, const Motion& motion) const noexcept {
    if (!is_resisted_by(motion, law_.law_count)) return false;
    const Vec3 hand = balance.hand_velocity - cross(balance.hand_turn, balance.centre);
    const Vec3 slip = linear(motion.rate) - hand;
    return slip.x * slip.x + slip.y * slip.y > skidding * skidding;
}

/// Whether a channel carries force against a point's way into the bone, away from the tool's axis. Its line of action
/// must pass near the point: a channel has no place of its own.
bool HapticLoop::is_resisted_at(Vec3 point, const Motion& motion) const noexcept {
    const double radius = std::sqrt(point.x * point.x + point.y * point.y);
    const Vec3 outwards = radius > 0.0 ? (1.0 / radius) * Vec3{point.x, point.y, 0.0} : Vec3{};
    for (std::uint32_t c = 0; c < law_.count; ++c) {
        const kerf_channel& channel = law_.channel[c];
        const Vec3 along{channel.d[0], channel.d[1], channel.d[2]}, moment{channel.d[3], channel.d[4], channel.d[5]};
        const double size = length(along);
        const bool is_two_sided = channel.kind == KERF_FRICTION || channel.kind == KERF_HOLD;
        const double into = dot(along, outwards);
        if (motion.lambda[c] == 0.0 || (is_two_sided ? std::abs(into) : into) < unresisted_slant * size) continue;
        if (length(cross(point, along) - moment) <= (radius + unresisted_reach) * size) return true;
    }
    return false;
}

/// Nothing stops a tool where its law has no channel: its author, not the hand, must learn of that.
void HapticLoop::look_for_unresisted(const Motion& motion, TickResult& result) noexcept {
    const ToolSolid &whole = outline().whole, &cutting = outline().cutting;
    const auto cuts_at = [&](double z) {
        return z >= cutting.end_z() && z <= cutting.tip_z() &&
               std::none_of(cutting.gaps().begin(), cutting.gaps().end(),
                            [z](const ToolSolid::Gap& gap) { return z < gap.front && z > gap.back; });
    };
    double beside = (cutting.end_z() - whole.end_z()) + (whole.tip_z() - cutting.tip_z());
    for (const ToolSolid::Gap& gap : cutting.gaps()) beside += gap.front - gap.back;
    const double deep = unresisted_depth();
    double deepest = 0.0;
    if (beside > 0.0 && is_bone_in_reach(0.0))
        whole.for_each_ring(std::max(least_ring_gap, beside / most_rings), [&](const std::array<Vec3, 8>& ring) {
            if (cuts_at(ring[0].z)) return;
            std::array<kerf_surface_point, 8> bone;
            view_.nearest(ring.data(), static_cast<std::uint32_t>(ring.size()), bone.data());
            for (std::size_t n = 0; n < ring.size(); ++n) {
                const auto body = static_cast<std::size_t>(bone[n].body);
                if (bone[n].body < 0 || body >= bodies_.size() || !bodies_[body]->is_cuttable) continue;
                if (-bone[n].distance <= deepest || is_resisted_at(ring[n], motion)) continue;
                deepest = -bone[n].distance;
                if (!is_unresisted_) unresisted_ = {ring[n], deepest};
            }
        });
    if (deepest >= deep && !std::exchange(is_unresisted_, true)) result.add_event("haptics.unresisted");
    if (deepest < 0.5 * deep) is_unresisted_ = false;
}

/// The tool stays where it is; a sound law goes on knowing the time.
void HapticLoop::rest(TickResult& result) noexcept {
    last_rate_ = {};
    following_.forget();
    result.bone_on_tool = result.coupled_on_hand = result.limited_on_hand = Vec6{};
    result.thrust = result.torque = result.power_hand = 0.0;
    if (result.is_quarantined) return;
    constexpr double nothing[most_channels] = {};
    commit(Vec6{}, nothing, Vec6{}, period_, result);
}

void HapticLoop::report(const Balance& balance, const Motion& motion, double share, TickResult& result) noexcept {
    // Bone on tool: minus the channels, plus what follows them.
    Vec6 bone = balance.following;
    for (std::uint32_t c = 0; c < law_.count; ++c)
        for (std::size_t i = 0; i < 6; ++i) bone[i] -= law_.channel[c].d[i] * motion.lambda[c];
    report_bone(bone, share, result);

    // Hand: the reaction of coupling and release damper, about the grip.
    const Vec3 arm = balance.centre - coupling_.grip();
    const auto on_hand = [&](Vec3 force, Vec3 torque) {
        return turned(world_from_tool_.rotation, make_vec6(-force, -torque - cross(arm, force)));
    };
    const Vec3 carried = motion.force - motion.release * balance.release_along;
    const Vec3 turn = angular(motion.rate);
    const Vec3 unlimited =
        balance.force.pull - balance.force.drag * (linear(motion.rate) + cross(turn, balance.centre));
    add(on_hand(unlimited, balance.torque.pull - balance.torque.drag * turn), share, result.coupled_on_hand);
    add(on_hand(clamped(carried, balance.force.limit), motion.torque), share, result.limited_on_hand);
    add(motion.rate, share, result.rate);
    result.released_on_hand =
        result.released_on_hand + (share * motion.release) * rotate(world_from_tool_.rotation, balance.release_along);
    result.power_hand += share * (dot(carried, balance.hand_velocity) + dot(motion.torque, balance.hand_turn));
}

void HapticLoop::report_bone(const Vec6& bone, double share, TickResult& result) const noexcept {
    result.thrust -= share * bone[2];
    result.torque -= share * bone[5];
    add(turned(world_from_tool_.rotation, bone), share, result.bone_on_tool);
}

/// Returns what the device makes of a torque on the hand, device side, world frame: a motor about the shaft makes its
/// part about it, about the handle's own z.
Vec3 HapticLoop::commanded_torque(Vec3 on_hand) noexcept {
    if (!coupling_.gains().shaft.is_driven()) return clamped(on_hand, coupling_.torque_limit());
    const double limit = coupling_.shaft_limit();
    const double about = dot(on_hand, rotate(world_from_tool_.rotation, {0, 0, 1}));
    return std::clamp(about + guard_.shaft_correction(period_), -limit, limit) *
           rotate(hand_.pose().rotation, {0, 0, 1});
}

void HapticLoop::command(TickResult& result) noexcept {
    const CouplingGains& gains = coupling_.gains();
    Vec6 wrench{};
    if (gate_.is_barred()) {
        add(before_fault_, gate_.gain(), wrench);
        result.command.setpoint.carried = linear(wrench);
    } else {
        const Vec3 correction = guard_.correction(period_);
        add(result.limited_on_hand, gains.force_scale, wrench);
        const Vec3 released = gains.force_scale * result.released_on_hand, force = linear(wrench);
        wrench = make_vec6(clamped(force + correction, coupling_.force_limit()), commanded_torque(angular(wrench)));
        const Vec3 arm = rotate(world_from_tool_.rotation, coupling_.grip());
        const Vec3 tool_rate = rotate(world_from_tool_.rotation, linear(result.rate)) +
                               cross(rotate(world_from_tool_.rotation, angular(result.rate)), arm);
        const Vec3 hand_rate = linear(hand_.rate()) + cross(angular(hand_.rate()), arm);
        const Vec3 sprung = force - released - gains.damping * (tool_rate - hand_rate);
        result.command.setpoint = {hand_.pose().position + (1.0 / gains.stiffness) * sprung,
                                   tool_rate,
                                   gains.stiffness,
                                   gains.damping,
                                   coupling_.force_limit(),
                                   clamped(released + correction, coupling_.force_limit())};
    }
    result.command.wrench = commanded_ = wrench;
}

TickResult HapticLoop::tick_direct(const DeviceSample& sample) noexcept {
    TickResult result;
    closed_.clear();
    bricks_left_ = CutTracker::most_bricks;
    const Pose last_handle = hand_.pose();
    if (hand_.take(sample, period_))
        guard_.observe(commanded_, make_vec6(hand_.pose().position - last_handle.position, {}), 0.0, 0.0);
    const Pose tool_from_next = inverse(world_from_tool_) * hand_.pose();
    result.rate = make_vec6((1.0 / period_) * tool_from_next.position,
                            (1.0 / period_) * small_rotation_vector(tool_from_next.rotation));

    result.is_quarantined = !ask(period_);
    double lambda[most_channels] = {};
    Vec6 following = result.is_quarantined ? Vec6{} : law_.wrench, bone{};
    for (std::uint32_t c = 0; c < law_.count; ++c) {
        const kerf_channel& channel = law_.channel[c];
        lambda[c] = channel_force(channel, dot(direction(channel), result.rate), period_).lambda;
        for (std::size_t i = 0; i < 6; ++i) {
            following[i] += channel.follow[i] * lambda[c];
            bone[i] -= channel.d[i] * lambda[c];
        }
    }
    for (std::size_t i = 0; i < 6; ++i) bone[i] += following[i];
    report_bone(bone, 1.0, result);
    result.coupled_on_hand = result.bone_on_tool;
    const CouplingGains& gains = coupling_.gains();
    Vec3 torque = clamped(angular(result.bone_on_tool), gains.torque_limit / gains.force_scale);
    if (gains.shaft.is_driven()) {
        const Vec3 shaft = rotate(hand_.pose().rotation, {0, 0, 1});
        const double most = gains.shaft.torque_limit / gains.force_scale;
        torque = std::clamp(dot(angular(result.bone_on_tool), shaft), -most, most) * shaft;
    }
    result.limited_on_hand =
        make_vec6(clamped(linear(result.bone_on_tool), gains.force_limit / gains.force_scale), torque);
    add(result.limited_on_hand, gains.force_scale, result.command.wrench);
    commanded_ = result.command.wrench;
    result.power_hand = -dot(bone, result.rate);
    if (!result.is_quarantined) commit(result.rate, lambda, following, period_, result);
    result.world_from_tool = world_from_tool_;
    ++tick_;
    return result;
}

void HapticLoop::command_drive(std::size_t drive, double value) noexcept {
    if (drive >= setup().drives.size() || !(value == value)) return;
    const kerf_drive& range = setup().tool->tool->drives[drive];
    drives_[drive] = std::clamp(value, range.min, range.max);
}

// ---- what it leads to ---------------------------------------------------------------------------------------------

void HapticLoop::commit(const Vec6& rate, const double* lambda, const Vec6& following, double step,
                        TickResult& result) noexcept {
    last_rate_ = rate;
    kerf_advance advance{};
    advance.size = sizeof advance;
    advance.channel_count = law_.law_count;
    std::copy(rate.begin(), rate.end(), advance.rate);
    advance.channel = law_.channel.data();
    advance.lambda = lambda;
    std::copy(following.begin(), following.end(), advance.following);
    advance.note = law_.note.data();
    kerf_action actions[KERF_MAX_ACTIONS];
    kerf_commit_out out{};
    out.size = sizeof out;
    out.action = actions;
    out.signal = signals_;
    kerf_thread thread{};
    out.thread = &thread;
    const kerf_tick_in in = tick_in(step);
    static_cast<void>(call_commit(*setup().force, in, advance, state_, out));
    if (out.thread_count > 0) keep(thread, result);

    if (law_.metal_channel >= 0 && lambda[law_.metal_channel] > 0.0) result.is_at_metal = true;

    // At the front: some edge met uncut bone in this step.
    bool is_at_front = false;
    for (std::uint32_t c = 0; c < law_.law_count; ++c) {
        const kerf_channel& channel = law_.channel[c];
        const double rate_along = dot(direction(channel), rate);
        if (channel.kind == KERF_CUT && lambda[c] > 0.0 && rate_along * step > channel.gap) is_at_front = true;
    }

    world_from_tool_ = advanced(world_from_tool_, rate, step);
    bool is_cutting = false;
    for (std::uint32_t a = 0; a < std::min(out.action_count, KERF_MAX_ACTIONS); ++a) {
        if (actions[a].kind == KERF_ACTION_CUT && actions[a].value == KERF_CUT_REGION) is_cutting = true;
        if (actions[a].kind == KERF_ACTION_CUT && actions[a].value == KERF_CUT_THREAD)
            result.is_stripping = outline().has_thread();
        do_as_told(actions[a], result);
    }
    if (is_cutting) result.is_cutting = true;
    held_.move(bodies_, world_from_tool_);
    for (const auto& body : bodies_) {
        const Pose body_from_tool = body->body_from(world_from_tool_);
        CutTracker& tracker = body->tracker;
        const bool is_cut = is_cutting && body->is_near && body->is_cuttable;
        if (is_cut) {
            take_closed(tracker, tracker.advance(body_from_tool, tick_));
        } else {
            take_closed(tracker, tracker.close(tick_));  // what was cut until now is gone
            tracker.restart(body_from_tool);
        }
        tracker.commit_passed(body_from_tool, is_cut && is_at_front, bricks_left_);
        bricks_left_ -= tracker.last_bricks();
    }
    look_around();
}

void HapticLoop::do_as_told(const kerf_action& action, TickResult& result) noexcept {
    const kerf_force& law = *setup().force->force;
    if (action.kind == KERF_ACTION_EVENT && action.value < law.event_count)
        result.add_event(law.events[action.value].id);
    if (action.kind == KERF_ACTION_RELEASE) held_.let_go();
    if (action.kind != KERF_ACTION_HOLD || action.value >= bodies_.size() || !bodies_[action.value]->is_present) return;
    if (bodies_.size() == 1)
        result.add_event("haptics.bone_is_whole");  // nobody takes the patient
    else
        held_.take(bodies_, action.value, world_from_tool_);
}

void HapticLoop::keep(const kerf_thread& thread, TickResult& result) noexcept {
    const bool is_new = thread.number == KERF_NEW_THREAD;
    if (!threads_.leave(thread, view_.places()) && is_new && threads_.is_full() && !std::exchange(has_no_room_, true))
        result.add_event("haptics.threads_full");
}

void HapticLoop::take_closed(CutTracker& tracker, int count) noexcept {
    for (int i = 0; i < count; ++i) {
        const CutRecord& record = tracker.closed(i);
        KERF_ASSERT(closed_.size() < closed_.capacity(), "there is room for the records of all parts and bodies");
        closed_.push_back(record);
        if (record.removes) ++removing_;
    }
}

bool HapticLoop::is_bone_in_reach(double margin) const noexcept {
    if (held_.is_any() && held_.is_near_another(bodies_, world_from_tool_, margin)) return true;
    return std::any_of(bodies_.begin(), bodies_.end(), [&](const auto& body) {
        return body->is_present && !held_.holds(body->id) &&
               is_in_reach_of_bone(*body->bone, outline().whole, body->body_from(world_from_tool_), margin);
    });
}

void HapticLoop::make_room() {
    for (const auto& body : bodies_) body->committed.reserve(bricks_of_a_tick);
    if (held_.lacks_points()) held_.find_points(bodies_);
}

void HapticLoop::close_stretches() noexcept {
    closed_.clear();
    close_open_stretches();
}

void HapticLoop::close_open_stretches() noexcept {
    for (const auto& body : bodies_) take_closed(body->tracker, body->tracker.close(tick_));
}

void HapticLoop::flush() {
    for (const auto& body : bodies_) body->tracker.flush();
}

}  // namespace kerf
