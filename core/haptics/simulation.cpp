// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/simulation.h"

#include <algorithm>
#include <cmath>

#include "kerf/assert.hpp"
#include "kerf/exact_math.hpp"

namespace kerf {

namespace {

constexpr std::size_t first_reserve = 512;  // bricks
constexpr std::size_t free_margin = 128;    // bricks kept ready for one tick
constexpr double hand_filter_hz = 100.0;
constexpr double release_from = 5e-3;  // [m/s] faster than the hand by more: released (R5)

Vec3 clamped(Vec3 v, double limit) noexcept {
    const double size = length(v);
    return size > limit ? (limit / size) * v : v;
}

Vec6 turned(Quat q, const Vec6& v) noexcept { return make_vec6(rotate(q, linear(v)), rotate(q, angular(v))); }

}  // namespace

bool outline_of(const ToolSetup& setup, ToolOutline& out, std::string& error) {
    constexpr std::uint32_t capacity = 64;
    kerf_profile_point points[capacity];
    kerf_tool_shape shape{};
    shape.size = sizeof shape;
    shape.profile = points;
    shape.profile_capacity = capacity;
    if (setup.tool->tool->shape(setup.tool_parameters.data(), &shape) != KERF_OK) {
        error = std::string("tool `") + setup.tool->id + "` cannot be made from these parameters: it refused them.";
        return false;
    }
    bool is_sound = shape.profile_count >= 2 && shape.profile_count <= capacity && shape.cutting_count >= 2 &&
                    shape.cutting_count <= shape.profile_count && std::isfinite(shape.grip_z);
    for (std::uint32_t i = 0; is_sound && i < shape.profile_count; ++i)
        is_sound = std::isfinite(points[i].z) && points[i].radius >= 0.0 && points[i].radius < 0.1 &&
                   (i == 0 || points[i].z < points[i - 1].z);
    if (!is_sound) {
        error = std::string("tool `") + setup.tool->id +
                "` gives an outline that is no solid of revolution: list (z, radius) from the tip backwards, in metres.";
        return false;
    }
    out.cutting = RevolutionSolid({points, points + shape.cutting_count});
    out.whole = RevolutionSolid({points, points + shape.profile_count});
    out.grip_z = shape.grip_z;
    return true;
}

Simulation::Simulation(const Body& body, ToolSetup setup, ToolOutline outline, const CouplingGains& gains, const Pose& start)
    : body_(&body),
      setup_(std::move(setup)),
      outline_(std::move(outline)),
      gains_(gains),
      committed_(body, first_reserve),
      exact_(body, first_reserve),
      tracker_(body, outline_.cutting, committed_),
      view_(body, committed_, tracker_),
      world_from_tool_(start),
      last_handle_(start) {
    const kerf_force& force = *setup_.force->force;
    state_storage_ = std::make_unique<std::byte[]>(force.state_size + force.state_align);
    void* aligned = state_storage_.get();
    std::size_t space = force.state_size + force.state_align;
    state_ = static_cast<std::byte*>(std::align(force.state_align, force.state_size, aligned, space));
    force.reset(state_);
    tracker_.restart(start);
    view_.place(start);
    to_stamp_.reserve(16);
}

Simulation::~Simulation() = default;

kerf_tick_in Simulation::tick_in() const noexcept {
    kerf_tick_in in{};
    in.size = sizeof in;
    in.tick = tick_;
    in.dt = dt;
    in.tool_params = setup_.tool_parameters.data();
    in.force_params = setup_.force_parameters.data();
    in.drive = setup_.drives.data();
    in.bone = &view_.query();
    return in;
}

bool Simulation::ask(kerf_law& law) noexcept {
    law.size = sizeof law;
    law.count = 0;
    law.channel = channels_;
    const kerf_tick_in in = tick_in();
    const kerf_status status = setup_.force->force->resist(&in, state_, &law);
    channel_count_ = 0;
    if (status != KERF_OK || law.count > KERF_MAX_CHANNELS) return false;
    for (std::uint32_t c = 0; c < law.count; ++c)
        if (!is_sound(channels_[c])) return false;
    channel_count_ = law.count;
    return true;
}

Vec6 Simulation::estimated_hand_rate(const Pose& handle) noexcept {
    const Vec3 turned_by = rotate(last_handle_.rotation, small_rotation_vector(conjugate(last_handle_.rotation) * handle.rotation));
    const Vec6 raw = make_vec6((1.0 / dt) * (handle.position - last_handle_.position), (1.0 / dt) * turned_by);
    last_handle_ = handle;
    constexpr double share = 1.0 - exp_exact(-2.0 * pi * hand_filter_hz * dt);
    for (std::size_t i = 0; i < 6; ++i) {
        hand_rate_first_[i] += share * (raw[i] - hand_rate_first_[i]);
        hand_rate_[i] += share * (hand_rate_first_[i] - hand_rate_[i]);
    }
    return hand_rate_;
}

TickResult Simulation::tick(const DeviceSample& sample) noexcept {
    TickResult result;
    const Pose handle = is_finite(sample.world_from_handle) ? sample.world_from_handle : last_handle_;
    const Vec6 hand_rate = estimated_hand_rate(handle);
    const Quat tool_from_world = conjugate(world_from_tool_.rotation);

    // The coupling's stretch at the grip, less what its anchor has slid.
    const Vec3 grip{0, 0, outline_.grip_z};
    const Vec3 stretch = rotate(tool_from_world, handle * grip - world_from_tool_ * grip - slip_);
    const Vec3 twist = small_rotation_vector(tool_from_world * handle.rotation * rotation_slip_);
    const double k = gains_.stiffness / gains_.force_scale, b = gains_.damping / gains_.force_scale;
    const double arm2 = gains_.rotation_arm * gains_.rotation_arm;
    const Vec3 hand_turn = rotate(tool_from_world, angular(hand_rate));
    const Vec3 hand_velocity = rotate(tool_from_world, linear(hand_rate)) + cross(hand_turn, grip);

    Balance balance;
    balance.force = {k * stretch + b * hand_velocity, b + dt * k, gains_.force_limit / gains_.force_scale};
    balance.torque = {arm2 * (k * twist + b * hand_turn), arm2 * (b + dt * k), gains_.torque_limit / gains_.force_scale};
    balance.grip = grip;
    balance.dt = dt;
    const double pull = length(balance.force.pull);
    if (pull > 0.0) {
        balance.release_along = (1.0 / pull) * balance.force.pull;
        balance.release_damping = gains_.release_time * k;
        balance.release_from = dot(hand_velocity, balance.release_along) + release_from;
    }

    kerf_law law;
    const bool has_law = ask(law);
    balance.channels = {channels_, channel_count_};
    balance.following = following(balance);

    Motion motion = solve(balance);
    result.is_quarantined = !has_law || !motion.has_converged;
    if (result.is_quarantined) {
        // No force, and the tool rests where it is until the law is sound again; the stretch is forgotten.
        motion = Motion{};
        slip_ = handle * grip - world_from_tool_ * grip;
        rotation_slip_ = conjugate(handle.rotation) * world_from_tool_.rotation;
        channel_count_ = 0;
    }
    result.rate = motion.rate;
    result.iterations = motion.iterations;

    // Bone on tool: minus the channels, plus what follows them.
    Vec6 bone = balance.following;
    if (result.is_quarantined) bone = Vec6{};
    for (std::uint32_t c = 0; c < channel_count_; ++c)
        for (std::size_t i = 0; i < 6; ++i) bone[i] -= channels_[c].d[i] * motion.lambda[c];
    report_wrench(bone, result);

    // Hand: the reaction of coupling and release damper.
    const Vec3 carried = motion.force - motion.release * balance.release_along;
    const Vec3 unlimited = balance.force.pull - balance.force.drag * (linear(motion.rate) + cross(angular(motion.rate), grip));
    const Vec3 unlimited_torque = balance.torque.pull - balance.torque.drag * angular(motion.rate);
    const Quat q = world_from_tool_.rotation;
    result.coupled_on_hand = turned(q, make_vec6(-unlimited, -unlimited_torque));
    result.limited_on_hand = turned(q, make_vec6(-clamped(carried, balance.force.limit), -motion.torque));
    for (std::size_t i = 0; i < 6; ++i) result.commanded[i] = gains_.force_scale * result.limited_on_hand[i];
    result.power_hand = dot(carried, hand_velocity) + dot(motion.torque, hand_turn);

    filter_lambda(balance, motion);

    if (!result.is_quarantined) commit(motion.rate, motion.lambda.data(), result);

    // The anchor slides: the stored stretch never carries more than the limit.
    const Vec3 after = handle * grip - world_from_tool_ * grip - slip_;
    slip_ = slip_ + after - clamped(after, balance.force.limit / k);
    const Quat turn_after = conjugate(world_from_tool_.rotation) * handle.rotation * rotation_slip_;
    const Vec3 turn = small_rotation_vector(turn_after);
    const Vec3 kept = clamped(turn, balance.torque.limit / (arm2 * k));
    if (!(kept == turn)) rotation_slip_ = normalized(rotation_slip_ * conjugate(turn_after) * quat_from_rotation_vector(kept));
    result.world_from_tool = world_from_tool_;
    ++tick_;
    return result;
}

double Simulation::filtered_lambda(std::uint32_t id) const noexcept {
    for (std::uint32_t f = 0; f < filtered_count_; ++f)
        if (filtered_[f].id == id) return filtered_[f].lambda;
    return 0.0;
}

Vec6 Simulation::following(const Balance& balance) const noexcept {
    Vec6 sum{};
    for (std::uint32_t c = 0; c < channel_count_; ++c) {
        const double lambda = filtered_lambda(channels_[c].id);
        for (std::size_t i = 0; i < 6; ++i) sum[i] += channels_[c].follow[i] * lambda;
    }
    // What follows is held by the coupling alone. More than it can carry has no balance: keep to half of it.
    const Vec3 about_grip = angular(sum) - cross(balance.grip, linear(sum));
    const double use = std::max(length(linear(sum)) / balance.force.limit, length(about_grip) / balance.torque.limit);
    if (use > 0.5)
        for (double& component : sum) component *= 0.5 / use;
    return sum;
}

/// λ̄ ← λ̄ + α(λ − λ̄), α = 1/(1 + μ²), μ = max |follow|/|d| in the coupling's own norm: unfiltered it diverges from
/// μ = 1.1 on. A channel that is gone forgets.
void Simulation::filter_lambda(const Balance& balance, const Motion& motion) noexcept {
    const double force_compliance = 1.0 / balance.force.drag;
    const double turn_compliance = 1.0 / (balance.torque.drag + balance.force.drag * dot(balance.grip, balance.grip));
    double mu2 = 0.0;
    for (std::uint32_t c = 0; c < channel_count_; ++c) {
        double d2 = 0.0, f2 = 0.0;
        for (std::size_t i = 0; i < 6; ++i) {
            const double weight = i < 3 ? force_compliance : turn_compliance;
            d2 += weight * channels_[c].d[i] * channels_[c].d[i];
            f2 += weight * channels_[c].follow[i] * channels_[c].follow[i];
        }
        mu2 = std::max(mu2, f2 / d2);
    }
    const double alpha = 1.0 / (1.0 + mu2);
    Filtered next[KERF_MAX_CHANNELS];
    for (std::uint32_t c = 0; c < channel_count_; ++c) {
        const double old = filtered_lambda(channels_[c].id);
        next[c] = {channels_[c].id, old + alpha * (motion.lambda[c] - old)};
    }
    std::copy(next, next + channel_count_, filtered_);
    filtered_count_ = channel_count_;
}

TickResult Simulation::tick_direct(const DeviceSample& sample) noexcept {
    TickResult result;
    const Pose tool_from_next = inverse(world_from_tool_) * sample.world_from_handle;
    result.rate = make_vec6((1.0 / dt) * tool_from_next.position, (1.0 / dt) * small_rotation_vector(tool_from_next.rotation));

    kerf_law law;
    result.is_quarantined = !ask(law);
    double lambda[KERF_MAX_CHANNELS] = {};
    Vec6 bone{};
    for (std::uint32_t c = 0; c < channel_count_; ++c) {
        lambda[c] = channel_force(channels_[c], dot(direction(channels_[c]), result.rate), dt).lambda;
        for (std::size_t i = 0; i < 6; ++i) bone[i] += (channels_[c].follow[i] - channels_[c].d[i]) * lambda[c];
    }
    report_wrench(bone, result);
    result.coupled_on_hand = result.limited_on_hand = result.bone_on_tool;
    for (std::size_t i = 0; i < 6; ++i) result.commanded[i] = gains_.force_scale * result.limited_on_hand[i];
    result.power_hand = -dot(bone, result.rate);
    if (!result.is_quarantined) commit(result.rate, lambda, result);
    result.world_from_tool = world_from_tool_;
    ++tick_;
    return result;
}

void Simulation::report_wrench(const Vec6& bone, TickResult& result) const noexcept {
    result.thrust = -bone[2];
    result.torque = -bone[5];
    result.bone_on_tool = turned(world_from_tool_.rotation, bone);
}

void Simulation::commit(const Vec6& rate, const double* lambda, TickResult& result) noexcept {
    kerf_advance advance{};
    advance.size = sizeof advance;
    advance.channel_count = channel_count_;
    std::copy(rate.begin(), rate.end(), advance.rate);
    advance.channel = channels_;
    advance.lambda = lambda;
    kerf_action actions[KERF_MAX_ACTIONS];
    kerf_commit_out out{};
    out.size = sizeof out;
    out.action = actions;
    out.signal = signals_;
    const kerf_tick_in in = tick_in();
    setup_.force->force->commit(&in, &advance, state_, &out);

    // At the front: some edge met uncut bone in this tick.
    bool is_at_front = false;
    for (std::uint32_t c = 0; c < channel_count_; ++c) {
        const double rate_along = dot(direction(channels_[c]), rate);
        if (channels_[c].kind == KERF_CUT && lambda[c] > 0.0 && rate_along * dt > channels_[c].gap) is_at_front = true;
    }

    world_from_tool_ = advanced(world_from_tool_, rate, dt);
    for (std::uint32_t a = 0; a < std::min(out.action_count, KERF_MAX_ACTIONS); ++a) {
        if (actions[a].kind == KERF_ACTION_CUT) result.is_cutting = true;
        if (actions[a].kind == KERF_ACTION_EVENT) result.events[result.event_count++] = actions[a].event;
    }
    if (result.is_cutting) {
        result.closed_records = tracker_.advance(world_from_tool_, tick_);
        for (int i = 0; i < result.closed_records; ++i)
            if (tracker_.closed(i).removes && to_stamp_.size() < to_stamp_.capacity()) to_stamp_.push_back(tracker_.closed(i));
        tracker_.commit_passed(world_from_tool_, is_at_front);
    } else {
        tracker_.restart(world_from_tool_);
    }
    view_.place(world_from_tool_);
}

void Simulation::after_tick() {
    for (const auto& record : to_stamp_) exact_.stamp(record, outline_.cutting);
    to_stamp_.clear();
    exact_.reserve(free_margin);
    committed_.reserve(free_margin);
}

void Simulation::finish() {
    const int closed = tracker_.close(tick_);
    for (int i = 0; i < closed; ++i)
        if (tracker_.closed(i).removes) to_stamp_.push_back(tracker_.closed(i));
    after_tick();
    tracker_.flush();
}

}  // namespace kerf
