// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/loop/coupling.h"

#include <algorithm>
#include <cmath>

#include "core/field/cut/sweep.h"
#include "kerf/assert.hpp"

namespace kerf {

namespace {
constexpr double release_from = 5e-3;  // [m/s] the release damper acts where the tool is faster than the hand by this
constexpr double release_time = 0.15;  // [s] maximum B_x / K_c of the release damper
/// [–] Maximum B_x T/m. With a damper rendered one tick late, a mass m oscillates from B_x = 0.8 m/T on. The filtered
/// hand rate adds more delay (`kerf stability`).
constexpr double sampled_damper = 0.22;
constexpr double nominal_period = 1e-3;  // [s]
constexpr double loose = 0.01;  // [–] fraction of the damping about the shaft that loose fingers keep [assumed]
/// Maximum change of force by one encoder count. A larger change is heard and felt while the hand is still (S-06).
constexpr double max_count_force = 0.08;  // [N]
}  // namespace

CouplingGains gains_for(const DeviceRecord& device, double force_scale, int latency) noexcept {
    KERF_ASSERT(latency >= 0 && latency <= max_latency, "whole ticks, at most two");
    CouplingGains gains;
    gains.stiffness = std::min(0.6 * device.largest_stiffness, 0.5 * device.stiffest_wall[latency]);
    gains.damping = std::clamp(nominal_period * (max_count_force / device.resolution - gains.stiffness), 0.0,
                               0.5 * device.largest_damping);
    gains.force_limit = device.peak_force;
    if (device.is_connected) gains.continuous_force = device.continuous_force;
    if (device.is_connected) gains.continuous_torque = device.continuous_torque;
    // Without actuated torque the limit is negligible: the tool in a clamp turns with the handle.
    gains.has_torque = device.peak_torque > 0.0;
    gains.torque_limit = gains.has_torque ? device.peak_torque : 0.01;
    if (const TorqueAxis& axis = device.axis; axis.peak_torque > 0.0) {
        KERF_ASSERT(axis.friction > 0.0 && axis.resolution > 0.0, "give the motor about the shaft both");
        KERF_ASSERT(!gains.has_torque, "a device that makes all torques has no motor about the shaft alone");
        const double stiffness = 0.5 * axis.friction / axis.resolution;
        gains.shaft = {axis.peak_torque, stiffness, nominal_period * stiffness, axis.resolution};
    }
    gains.resolution = device.resolution;
    gains.spare_damping = device.largest_damping - gains.damping;
    gains.force_scale = force_scale;
    gains.release_damping = std::min(release_time * gains.stiffness, sampled_damper * device.mass / nominal_period);
    return gains;
}

double force_scale_for(const DeviceRecord& device, double work_force) noexcept {
    return work_force > 0.0 ? std::min(1.0, 0.6 * device.continuous_force / work_force) : 1.0;
}

namespace {

constexpr double handpiece_mass = 0.5, handpiece_gyration = 50e-3;  // [kg], [m] about its centre [assumed]

/// Returns the damping coefficient at which `inertia` [kg or kg·m²] on a spring of `stiffness` has the hand's damping
/// ratio. It is put in series with the device's damping `of_device`; returns 0 if that is 0.
double damped(const HandCompliance& held, double stiffness, double inertia, double of_device) noexcept {
    const double own = 2.0 * held.damping_ratio * std::sqrt(stiffness * inertia);
    return own / (1.0 + own / of_device);
}

}  // namespace

Spring combined_spring(const CouplingGains& gains, const std::optional<HandCompliance>& held, double grip_z,
                       TipBending tip) noexcept {
    const double k = gains.stiffness / gains.force_scale, b = gains.damping / gains.force_scale;
    const double arm2 = gains.rotation_arm * gains.rotation_arm;
    double turn = arm2 * k, along = k;
    if (held) {
        turn = gains.has_torque ? std::min(turn, held->turn_stiffness) : held->turn_stiffness;
        along = std::min(along, held->axial_stiffness);
    }
    const ShaftGains& shaft = gains.shaft;
    const double about = shaft.is_driven() ? std::min(turn, shaft.stiffness / gains.force_scale) : turn;
    const Compliance at_grip = Compliance{1.0 / k, 0.0, 1.0 / turn} + at_point_ahead(bending_compliance(tip), grip_z);
    const CentredSpring across = centred(at_grip);
    Spring spring{.centre_z = grip_z + across.ahead,
                  .stiffness = {across.shift, along},
                  .damping = (b / k) * Split(across.shift, along),
                  .turn_stiffness = {across.turn, about},
                  .turn_damping = (b / k) * Split(across.turn, about)};
    if (held) {
        constexpr double turning = handpiece_mass * handpiece_gyration * handpiece_gyration;
        spring.damping = {damped(*held, across.shift, handpiece_mass, b), b};  // along: of the device alone
        const double maximum = gains.has_torque ? arm2 * b : HUGE_VAL;
        const double max_about = shaft.is_driven() ? shaft.damping / gains.force_scale : maximum;
        spring.turn_damping = {damped(*held, across.turn, turning, maximum), damped(*held, about, turning, max_about)};
    }
    return spring;
}

Coupling::Coupling(const CouplingGains& gains, const ToolGrip& handling) noexcept
    : gains_(gains),
      held_(gains.is_held ? std::optional(handling.hands > 1 ? two_hands : one_hand) : std::nullopt),
      grip_{0, 0, handling.grip_z},
      spring_(combined_spring(gains, held_, handling.grip_z, handling.bending)) {}

void Coupling::hold(const Pose& world_from_handle, const Vec6& hand_rate, const Pose& tool, double dt,
                    Balance& out) const noexcept {
    const Quat tool_from_world = conjugate(tool.rotation);
    const Vec3 twisted = small_rotation_vector(twist(world_from_handle, tool));
    out.centre = centre();
    out.hand_turn = rotate(tool_from_world, angular(hand_rate));
    out.hand_velocity = rotate(tool_from_world, linear(hand_rate)) + cross(out.hand_turn, out.centre);
    out.force = {spring_.stiffness * stretch(world_from_handle, tool) + spring_.damping * out.hand_velocity,
                 spring_.damping + dt * spring_.stiffness, max_force()};
    out.torque = {spring_.turn_stiffness * twisted + spring_.turn_damping * out.hand_turn,
                  spring_.turn_damping + dt * spring_.turn_stiffness, max_torque()};
    if (is_loose_) {
        out.torque.pull.z = 0.0;
        out.torque.drag.along = loose * spring_.turn_damping.along;
    }
    out.dt = dt;
    out.release_damping = 0.0;
    const double pull = out.force.pull.z;
    if (pull == 0.0) return;
    out.release_along = {0, 0, pull > 0.0 ? 1.0 : -1.0};
    out.release_damping = gains_.release_damping / gains_.force_scale;
    // If the hand moves against the spring's pull, the tool is compared with rest instead of with the hand.
    out.release_from = std::max(0.0, dot(out.hand_velocity, out.release_along)) + release_from;
}

void Coupling::slide(const Pose& world_from_handle, const Pose& tool) noexcept {
    const Vec3 after = stretch(world_from_handle, tool);
    slip_ = slip_ + rotate(tool.rotation, after - clamped(after, max_force() / spring_.stiffness));
    const Quat turn_after = twist(world_from_handle, tool);
    const Vec3 turn = small_rotation_vector(turn_after);
    Vec3 kept = clamped(turn, max_torque() / spring_.turn_stiffness);
    if (is_loose_) kept.z = 0.0;
    if (!(kept == turn))
        rotation_slip_ = normalized(rotation_slip_ * conjugate(turn_after) * quat_from_rotation_vector(kept));
}

void Coupling::relax(const Pose& world_from_handle, const Pose& tool) noexcept {
    slip_ = world_from_handle * centre() - tool * centre();
    rotation_slip_ = normalized(conjugate(world_from_handle.rotation) * tool.rotation);
}

Pose Coupling::grasp(const Pose& tool) const noexcept {
    const Quat rotation = conjugate(rotation_slip_);  // of the handle, tool frame
    const Vec3 slip = rotate(conjugate(tool.rotation), slip_);
    return {slip + centre() - rotate(rotation, centre()), rotation};
}

bool Coupling::straighten(double fraction) noexcept {
    constexpr double straight = 1e-6;  // [m], [–] a smaller slip is set to zero
    const Pose left = between({slip_, rotation_slip_}, identity_pose(), fraction);
    slip_ = left.position;
    rotation_slip_ = left.rotation;
    const bool is_left =
        length(slip_) > straight || length(Vec3{rotation_slip_.x, rotation_slip_.y, rotation_slip_.z}) > straight;
    if (!is_left) {
        slip_ = {};
        rotation_slip_ = {1, 0, 0, 0};
    }
    return is_left;
}

double Coupling::stored(const Pose& world_from_handle, const Pose& tool) const noexcept {
    const Vec3 e = clamped(stretch(world_from_handle, tool), max_force() / spring_.stiffness);
    double energy = 0.5 * dot(e, spring_.stiffness * e);
    if (gains_.has_torque) {
        const Split maximum = torque_limit() / gains_.force_scale;
        const Vec3 turn =
            clamped(small_rotation_vector(twist(world_from_handle, tool)), maximum / spring_.turn_stiffness);
        energy += 0.5 * dot(turn, spring_.turn_stiffness * turn);
    } else if (gains_.shaft.is_driven() && !is_loose_) {
        // The motor's torque grows with the angle up to its limit and is constant above. The energy is the area below
        // that curve.
        const double stiffness = spring_.turn_stiffness.along, maximum = shaft_limit() / gains_.force_scale;
        const double turn =
            std::min(std::abs(small_rotation_vector(twist(world_from_handle, tool)).z), max_torque().along / stiffness);
        const double sprung = std::min(turn, maximum / stiffness);
        energy += 0.5 * stiffness * sprung * sprung + maximum * (turn - sprung);
    }
    return gains_.force_scale * energy;
}

}  // namespace kerf
