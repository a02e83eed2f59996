// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/haptics/device_record.h"
#include "core/haptics/solve.h"

/// The spring and damper between the hand and the tool.
namespace kerf {

/// Gains on the device's side; divided by the force scale they act on the bone's.
struct CouplingGains {
    double stiffness = 0.0;        ///< K_c [N/m]
    double damping = 0.0;          ///< B_c [N·s/m]
    double force_limit = 0.0;      ///< [N]
    double torque_limit = 0.0;     ///< [N·m]
    bool has_torque = false;       ///< the device makes torques: they count for what the hand is given
    double resolution = 0.0;       ///< [m] of one count of the device's encoders
    double spare_damping = 0.0;    ///< [N·s/m] the most the passivity controller may add
    double force_scale = 1.0;      ///< [–] device newtons per bone newton, one for force and torque
    double rotation_arm = 0.05;    ///< [m] K_rot = K arm², B_rot = B arm² [assumed]
    double release_damping = 0.0;  ///< [N·s/m] between hand and tool at breakthrough (docs/design/tick.md)
};

/// What a device may be asked for when its forces come `latency` ticks late (0 … longest_latency, asserted):
///
///     K_c = min(0.6 × the stiffness of its record, 0.5 × the stiffest wall that rests on it),
///     B_c = min(0.5 × its damping, T (0.08 N / Δ − K_c)), Δ one count of its encoders,
///     B_x = min(0.15 s × K_c, 0.22 m/T)
///
/// B_c and B_x are judgements; all are held against S-01, S-02, S-06, S-15 and S-19 (docs/design/tick.md).
[[nodiscard]] CouplingGains gains_for(const DeviceRecord& device, double force_scale, int latency = 0) noexcept;

/// The largest scale at which `work_force` [N, bone] stays within 0.6 of what the device can hold, at most 1 (R5).
[[nodiscard]] double force_scale_for(const DeviceRecord& device, double work_force) noexcept;

/// The coupling as it stands: where its anchor is. The anchor slides so that the stretch never stores more than the
/// device can make felt.
class Coupling {
public:
    Coupling(const CouplingGains& gains, Vec3 grip) : gains_(gains), grip_(grip) {}

    /// Of its limits of force and torque, these shares are allowed from now on (0 … 1]: the anchor slides so much the
    /// sooner. Force comes back after a fault by allowing more, not by scaling what it would be: what is scaled up
    /// gives more than it took (A10). [haptic, nonblocking]
    void allow(double of_force, double of_torque) noexcept {
        force_share_ = of_force;
        torque_share_ = of_torque;
    }

    /// What the solve must balance for a step of `dt`: all of `out` but the channels and what follows them.
    /// [haptic, nonblocking]
    void hold(const Pose& world_from_handle, const Vec6& hand_rate, const Pose& world_from_tool, double dt,
              Balance& out) const noexcept;
    /// After the step.   [haptic, nonblocking]
    void slide(const Pose& world_from_handle, const Pose& world_from_tool) noexcept;
    /// Nothing is stored any more: hand and tool go on from where they are.   [haptic, nonblocking]
    void let_go(const Pose& world_from_handle, const Pose& world_from_tool) noexcept;

    /// What the stretch holds [J], on the device's side.   [haptic, nonblocking]
    [[nodiscard]] double stored(const Pose& world_from_handle, const Pose& world_from_tool) const noexcept;
    /// Where the device would have to be for the spring to be slack: the grip, world frame [m].
    [[nodiscard]] Vec3 slack_grip(const Pose& world_from_tool) const noexcept {
        return world_from_tool * grip_ + slip_;
    }
    [[nodiscard]] const CouplingGains& gains() const noexcept { return gains_; }
    [[nodiscard]] double force_limit() const noexcept { return force_share_ * gains_.force_limit; }     ///< [N]
    [[nodiscard]] double torque_limit() const noexcept { return torque_share_ * gains_.torque_limit; }  ///< [N·m]
    [[nodiscard]] Vec3 grip() const noexcept { return grip_; }  ///< tool frame [m]

private:
    [[nodiscard]] Vec3 stretch(const Pose& handle, const Pose& tool) const noexcept {
        return handle * grip_ - tool * grip_ - slip_;
    }
    [[nodiscard]] Quat twist(const Pose& handle, const Pose& tool) const noexcept {
        return conjugate(tool.rotation) * handle.rotation * rotation_slip_;
    }
    [[nodiscard]] double stiffness() const noexcept { return gains_.stiffness / gains_.force_scale; }
    [[nodiscard]] double damping() const noexcept { return gains_.damping / gains_.force_scale; }

    CouplingGains gains_;
    Vec3 grip_;
    double force_share_ = 1.0, torque_share_ = 1.0;
    Vec3 slip_{};  ///< how far the anchor has slid, world frame [m]
    Quat rotation_slip_{1, 0, 0, 0};
};

/// `v`, or as much of it as is `limit` long.
[[nodiscard]] inline Vec3 clamped(Vec3 v, double limit) noexcept {
    const double size = length(v);
    return size > limit ? (limit / size) * v : v;
}

}  // namespace kerf
