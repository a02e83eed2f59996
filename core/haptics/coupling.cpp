// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/coupling.h"

#include <algorithm>

#include "kerf/assert.hpp"

namespace kerf {

namespace {
constexpr double release_from = 5e-3;  // [m/s] faster than the hand by more: released (R5)
constexpr double release_time = 0.15;  // [s] (R5)
/// A damper rendered a tick late shakes a mass m from 0.8 m/T on; the hand's rate is later still (`kerf stability`).
constexpr double sampled_damper = 0.22;
constexpr double nominal_period = 1e-3;  // [s]
/// What one count of the encoders may change the force by: more is heard and felt while a hand holds still (S-06).
constexpr double felt_count = 0.08;  // [N]
}  // namespace

CouplingGains gains_for(const DeviceRecord& device, double force_scale, int latency) noexcept {
    KERF_ASSERT(latency >= 0 && latency <= longest_latency, "whole ticks, at most two");
    CouplingGains gains;
    gains.stiffness = std::min(0.6 * device.largest_stiffness, 0.5 * device.stiffest_wall[latency]);
    gains.damping = std::clamp(nominal_period * (felt_count / device.resolution - gains.stiffness), 0.0,
                               0.5 * device.largest_damping);
    gains.force_limit = device.peak_force;
    // Without actuated torque the rotation is dragged through a slip coupling that carries next to nothing.
    gains.has_torque = device.peak_torque > 0.0;
    gains.torque_limit = gains.has_torque ? device.peak_torque : 0.01;
    gains.resolution = device.resolution;
    gains.spare_damping = device.largest_damping - gains.damping;
    gains.force_scale = force_scale;
    gains.release_damping = std::min(release_time * gains.stiffness, sampled_damper * device.mass / nominal_period);
    return gains;
}

double force_scale_for(const DeviceRecord& device, double work_force) noexcept {
    return work_force > 0.0 ? std::min(1.0, 0.6 * device.continuous_force / work_force) : 1.0;
}

void Coupling::hold(const Pose& handle, const Vec6& hand_rate, const Pose& tool, double dt,
                    Balance& out) const noexcept {
    const Quat tool_from_world = conjugate(tool.rotation);
    const Vec3 stretched = rotate(tool_from_world, stretch(handle, tool));
    const Vec3 twisted = small_rotation_vector(tool_from_world * handle.rotation * rotation_slip_);
    const double k = stiffness(), b = damping(), arm2 = gains_.rotation_arm * gains_.rotation_arm;
    out.hand_turn = rotate(tool_from_world, angular(hand_rate));
    out.hand_velocity = rotate(tool_from_world, linear(hand_rate)) + cross(out.hand_turn, grip_);
    out.force = {k * stretched + b * out.hand_velocity, b + dt * k, force_limit() / gains_.force_scale};
    out.torque = {arm2 * (k * twisted + b * out.hand_turn), arm2 * (b + dt * k), torque_limit() / gains_.force_scale};
    out.grip = grip_;
    out.dt = dt;
    out.release_damping = 0.0;
    const double pull = length(out.force.pull);
    if (pull <= 0.0) return;
    out.release_along = (1.0 / pull) * out.force.pull;
    out.release_damping = gains_.release_damping / gains_.force_scale;
    // From the hand's speed towards the tool on, or from rest: a hand that backs off a wall is not let go by it.
    out.release_from = std::max(0.0, dot(out.hand_velocity, out.release_along)) + release_from;
}

void Coupling::slide(const Pose& handle, const Pose& tool) noexcept {
    const Vec3 after = stretch(handle, tool);
    slip_ = slip_ + after - clamped(after, force_limit() / gains_.stiffness);
    const Quat turn_after = twist(handle, tool);
    const Vec3 turn = small_rotation_vector(turn_after);
    const Vec3 kept = clamped(turn, torque_limit() / (gains_.rotation_arm * gains_.rotation_arm * gains_.stiffness));
    if (!(kept == turn))
        rotation_slip_ = normalized(rotation_slip_ * conjugate(turn_after) * quat_from_rotation_vector(kept));
}

void Coupling::let_go(const Pose& handle, const Pose& tool) noexcept {
    slip_ = handle * grip_ - tool * grip_;
    rotation_slip_ = normalized(conjugate(handle.rotation) * tool.rotation);
}

double Coupling::stored(const Pose& handle, const Pose& tool) const noexcept {
    const Vec3 e = clamped(stretch(handle, tool), force_limit() / gains_.stiffness);
    double energy = 0.5 * gains_.stiffness * dot(e, e);
    if (gains_.has_torque) {
        const double k = gains_.stiffness * gains_.rotation_arm * gains_.rotation_arm;
        const Vec3 turn = clamped(small_rotation_vector(twist(handle, tool)), torque_limit() / k);
        energy += 0.5 * k * dot(turn, turn);
    }
    return energy;
}

}  // namespace kerf
