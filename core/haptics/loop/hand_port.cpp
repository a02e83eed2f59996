// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/loop/hand_port.h"

#include <algorithm>
#include <utility>

#include "core/field/cut/sweep.h"

namespace kerf {

namespace {

constexpr double realigning_speed = 10e-3;  // [m/s] maximum after a fault: a hand can follow it [assumed]
constexpr double straightening = 0.3;  // [s] time constant with which a hand straightens a new tool in air [assumed]

PassivityGuard::Port port_of_forces(const CouplingGains& gains) noexcept {
    return {gains.spare_damping, gains.stiffness * gains.resolution * gains.resolution, gains.resolution};
}

PassivityGuard::Port port_of_shaft(const Coupling& coupling) noexcept {
    const CouplingGains& gains = coupling.gains();
    const double count = gains.shaft.resolution;
    return {gains.shaft.damping, gains.force_scale * coupling.spring().turn_stiffness.along * count * count, count};
}

}  // namespace

HandPort::HandPort(const CouplingGains& gains, const ToolGrip& handling, const Pose& start)
    : motion_(start),
      last_pose_(start),
      coupling_(gains, handling),
      guard_(port_of_forces(gains), port_of_shaft(coupling_)) {}

void HandPort::take_tool(const ToolGrip& handling, const Pose& world_from_tool) noexcept {
    coupling_ = Coupling(coupling_.gains(), handling);
    relax(world_from_tool);
    is_realigning_ = true;
    was_anchored_again_ = false;
    guard_.set_shaft_port(port_of_shaft(coupling_));
    guard_.restart();
}

bool HandPort::read(const DeviceSample& sample, const Pose& world_from_tool, double kinetic_energy,
                    double dt) noexcept {
    last_pose_ = pose();
    const bool is_steady = motion_.take(sample, dt);
    if (is_steady) {
        const CouplingGains& gains = coupling_.gains();
        const Vec3 grip = coupling_.grip();
        const Quat turn = conjugate(last_pose_.rotation) * pose().rotation;
        const bool has_shaft = gains.shaft.is_driven();
        const Vec3 turned_by =
            gains.has_torque || has_shaft ? rotate(last_pose_.rotation, small_rotation_vector(turn)) : Vec3{};
        guard_.observe(commanded_, make_vec6(pose() * grip - last_pose_ * grip, turned_by), supplied_,
                       coupling_.stored(pose(), world_from_tool) + gains.force_scale * kinetic_energy,
                       has_shaft ? small_rotation_vector(turn).z : 0.0);
    }
    supplied_ = 0.0;
    return is_steady;
}

void HandPort::read_direct(const DeviceSample& sample, double dt) noexcept {
    last_pose_ = pose();
    if (motion_.take(sample, dt))
        guard_.observe(commanded_, make_vec6(pose().position - last_pose_.position, {}), 0.0, 0.0);
}

Pose HandPort::pose_after(int part, int parts) const noexcept {
    return part == parts ? pose() : between(last_pose_, pose(), static_cast<double>(part) / parts);
}

void HandPort::add_wrenches(const Balance& balance, const Motion& motion, double weight, const Pose& world_from_tool,
                            TickResult& result) const noexcept {
    // The hand gets the reaction of coupling and release damper, about the grip.
    const Vec3 arm = balance.centre - coupling_.grip();
    const auto on_hand = [&](Vec3 force, Vec3 torque) {
        return rotated(world_from_tool.rotation, make_vec6(-force, -torque - cross(arm, force)));
    };
    const Vec3 carried = motion.force - motion.release * balance.release_along;
    const Vec3 turn = angular(motion.rate);
    const Vec3 unlimited =
        balance.force.pull - balance.force.drag * (linear(motion.rate) + cross(turn, balance.centre));
    add_scaled(on_hand(unlimited, balance.torque.pull - balance.torque.drag * turn), weight, result.coupled_on_hand);
    add_scaled(on_hand(clamped(carried, balance.force.limit), motion.torque), weight, result.limited_on_hand);
    result.released_on_hand =
        result.released_on_hand + (weight * motion.release) * rotate(world_from_tool.rotation, balance.release_along);
    result.power_hand += weight * (dot(carried, balance.hand_velocity) + dot(motion.torque, balance.hand_turn));
}

void HandPort::credit_motor(const Balance& balance, const Motion& motion, double dt) noexcept {
    supplied_ += force_scale() * std::max(0.0, dot(balance.following, motion.rate)) * dt;
}

void HandPort::realign(double dt) noexcept {
    if (!is_realigning_) return;
    double fraction = std::min(1.0, dt / straightening);
    if (const double slip = coupling_.slip(); was_anchored_again_ && slip * fraction > realigning_speed * dt)
        fraction = realigning_speed * dt / slip;
    is_realigning_ = coupling_.straighten(fraction);
}

void HandPort::gate(bool is_steady, const Pose& world_from_tool, double dt, TickResult& result) noexcept {
    const bool was_closed = is_gate_closed();
    gate_.step(is_steady && !result.is_quarantined, dt);
    result.is_closed_or_closing = is_gate_closed();
    if (result.is_closed_or_closing && !was_closed) {
        before_fault_ = commanded_;
        result.add_event(is_steady ? "haptics.quarantined" : "haptics.hand_lost");
    }
    if (was_closed && !result.is_closed_or_closing) {
        guard_.restart();
        is_realigning_ = was_anchored_again_ = true;
        result.add_event(TickResult::anchored_again);
    }
    if (was_closed || result.is_closed_or_closing) relax(world_from_tool);
}

/// Returns the torque that the device makes for the torque `on_hand`, within its limit. Both are world frame, device
/// side. A motor about the shaft makes only the component about the tool's z, and makes it about the handle's z.
Vec3 HandPort::torque_for_device(Vec3 on_hand, const Pose& world_from_tool, double dt) noexcept {
    if (!coupling_.gains().shaft.is_driven()) return clamped(on_hand, coupling_.torque_limit());
    const double limit = coupling_.shaft_limit();
    const double about = dot(on_hand, rotate(world_from_tool.rotation, {0, 0, 1}));
    return std::clamp(about + guard_.shaft_correction(dt), -limit, limit) * rotate(pose().rotation, {0, 0, 1});
}

void HandPort::command_coupled(const Pose& world_from_tool, double dt, TickResult& result, Vec6& wrench) noexcept {
    const CouplingGains& gains = coupling_.gains();
    const Vec3 correction = guard_.correction(dt);
    add_scaled(result.limited_on_hand, gains.force_scale, wrench);
    const Vec3 released = gains.force_scale * result.released_on_hand, force = linear(wrench);
    wrench = make_vec6(clamped(force + correction, coupling_.force_limit()),
                       torque_for_device(angular(wrench), world_from_tool, dt));
    const Vec3 arm = rotate(world_from_tool.rotation, coupling_.grip());
    const Vec3 tool_rate = rotate(world_from_tool.rotation, linear(result.rate)) +
                           cross(rotate(world_from_tool.rotation, angular(result.rate)), arm);
    const Vec3 hand_rate = linear(motion_.rate()) + cross(angular(motion_.rate()), arm);
    const Vec3 sprung = force - released - gains.damping * (tool_rate - hand_rate);
    result.command.setpoint = {pose().position + (1.0 / gains.stiffness) * sprung,
                               tool_rate,
                               gains.stiffness,
                               gains.damping,
                               coupling_.force_limit(),
                               clamped(released + correction, coupling_.force_limit())};
}

void HandPort::command(const Pose& world_from_tool, double dt, TickResult& result) noexcept {
    Vec6 wrench{};
    if (is_gate_closed()) {
        add_scaled(before_fault_, gate_.gain(), wrench);
        result.command.setpoint.carried = linear(wrench);
    } else {
        command_coupled(world_from_tool, dt, result, wrench);
    }
    result.command.wrench = commanded_ = wrench;
    follow_heat(dt, result);
    if (!result.is_closed_or_closing) {
        const double limit = coupling_.gains().force_limit, force = length(linear(commanded_));
        coupling_.set_allowed_fractions(
            std::min(gate_.usable_fraction(limit, force, dt), force_heat_.usable_fraction()),
            std::min(gate_.gain(), torque_heat_.usable_fraction()));
    }
    result.is_coming_back = gate_.state() == ForceGate::State::opening;
}

/// Follows the heat of the motors under the command of this tick.
void HandPort::follow_heat(double dt, TickResult& result) noexcept {
    const CouplingGains& gains = coupling_.gains();
    const bool was_warm = force_heat_.is_warm() || torque_heat_.is_warm();
    force_heat_.take(length(linear(commanded_)), gains.continuous_force, gains.force_limit, dt);
    torque_heat_.take(length(angular(commanded_)), gains.continuous_torque, gains.torque_limit, dt);
    if (!was_warm && (force_heat_.is_warm() || torque_heat_.is_warm())) result.add_event("haptics.motors_warm");
}

void HandPort::command_direct(double dt, TickResult& result) noexcept {
    const CouplingGains& gains = coupling_.gains();
    Vec3 torque = clamped(angular(result.bone_on_tool), gains.torque_limit / gains.force_scale);
    if (gains.shaft.is_driven()) {
        const Vec3 shaft = rotate(pose().rotation, {0, 0, 1});
        const double limit = gains.shaft.torque_limit / gains.force_scale;
        torque = std::clamp(dot(angular(result.bone_on_tool), shaft), -limit, limit) * shaft;
    }
    result.coupled_on_hand = result.bone_on_tool;
    result.limited_on_hand = make_vec6(
        clamped(linear(result.bone_on_tool), force_heat_.usable_fraction() * gains.force_limit / gains.force_scale),
        torque);
    add_scaled(result.limited_on_hand, gains.force_scale, result.command.wrench);
    commanded_ = result.command.wrench;
    follow_heat(dt, result);
}

}  // namespace kerf
