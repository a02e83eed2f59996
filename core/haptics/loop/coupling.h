// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/haptics/law/handling.h"
#include "core/haptics/law/solve.h"
#include "core/haptics/loop/device_record.h"

/// The spring and damper between the hand and the tool.
namespace kerf {

/// What gives way between the handle and the tool when a hand holds it. Bone side, the same on every device.
struct Hold {
    double turn_stiffness = 0.0;   ///< [N·m/rad] of the wrist, at the grip
    double axial_stiffness = 0.0;  ///< [N/m] at most
    double strength = 0.0;         ///< [N·m] about lines across the shaft; beyond it the tool turns in the hand
    double twist = 0.0;            ///< [N·m] about the shaft
    double damping_ratio = 0.5;    ///< of a handpiece of 0.5 kg on it [assumed]
};
/// Of a drill: 10 N·m/rad and 5 N·m [assumed], 7 N·m [maxima of 7 … 12 measured], 7.5 N/mm, which every device can
/// make.
inline constexpr Hold one_hand{.turn_stiffness = 10.0, .axial_stiffness = 7.5e3, .strength = 7.0, .twist = 5.0};
/// Of a saw: arms of 5 N/mm, 150 mm apart, and two wrists [assumed].
inline constexpr Hold two_hands{.turn_stiffness = 60.0, .axial_stiffness = 7.5e3, .strength = 20.0, .twist = 20.0};

/// Gains of a motor about the shaft, on the device's side. One count of its encoder changes its torque by no more than
/// its friction, in halves for spring and damper, so a hand that holds still feels no count.
struct ShaftGains {
    double torque_limit = 0.0;  ///< [N·m]; 0: the device has no such motor
    double stiffness = 0.0;     ///< [N·m/rad] at most
    double damping = 0.0;       ///< [N·m·s/rad] at most, of the coupling and of the passivity controller each
    double resolution = 0.0;    ///< [rad] of one count

    [[nodiscard]] bool is_driven() const noexcept { return torque_limit > 0.0; }
};

/// Gains on the device's side; divided by the force scale they act on the bone's.
struct CouplingGains {
    double stiffness = 0.0;        ///< K_c [N/m]
    double damping = 0.0;          ///< B_c [N·s/m]
    double force_limit = 0.0;      ///< [N]
    double torque_limit = 0.0;     ///< [N·m]
    bool has_torque = false;       ///< the device makes torques: they count for what the hand is given
    ShaftGains shaft{};            ///< of a device with a motor about the shaft alone
    double resolution = 0.0;       ///< [m] of one count of the device's encoders
    double spare_damping = 0.0;    ///< [N·s/m] the most the passivity controller may add
    double force_scale = 1.0;      ///< [–] device newtons per bone newton, one for force and torque
    double rotation_arm = 0.05;    ///< [m] K_rot = K arm², B_rot = B arm² [assumed]
    double release_damping = 0.0;  ///< [N·s/m] between hand and tool at breakthrough (docs/design/tick.md)
    bool is_held = false;          ///< in hands, as many as the tool asks for; else the handle clamps it
};

/// What a device may be asked for when its forces come `latency` ticks late (0 … longest_latency, asserted):
///
///     K_c = min(0.6 × the stiffness of its record, 0.5 × the stiffest wall that rests on it),
///     B_c = min(0.5 × its damping, T (0.08 N / Δ − K_c)), Δ one count of its encoders,
///     B_x = min(0.15 s × K_c, 0.22 m/T)
///
/// and of a motor about the shaft with friction τ and counts of φ: at most τ/2φ of stiffness and T τ/2φ of damping.
/// B_c and B_x are judgements; all are held against S-01, S-02, S-06, S-15 and S-19 (docs/design/tick.md).
[[nodiscard]] CouplingGains gains_for(const DeviceRecord& device, double force_scale, int latency = 0) noexcept;

/// The same with the tool in hands.   [any] pure.
[[nodiscard]] inline CouplingGains in_hands(CouplingGains gains) noexcept {
    gains.is_held = true;
    return gains;
}

/// The largest scale at which `work_force` [N, bone] stays within 0.6 of what the device can hold, at most 1 (R5).
[[nodiscard]] double force_scale_for(const DeviceRecord& device, double work_force) noexcept;

/// The coupling as the solve sees it. Bone side.
struct Spring {
    double centre_z = 0.0;               ///< [m] where force and torque do not mix
    Split stiffness, damping;            ///< [N/m], [N·s/m]
    Split turn_stiffness, turn_damping;  ///< [N·m/rad], [N·m·s/rad]
};
/// Returns device, hands and shaft as one spring; without `held` the handle clamps the tool. A device that makes no
/// torques leaves a turn to the wrist: turning its handle costs nothing. A motor about the shaft bounds the turn about
/// it. In hands every damper has a ratio of its own, so the sum is exact at rest only.   [any] pure.
///
/// Source: docs/design/tick.md, "One spring".
[[nodiscard]] Spring folded(const CouplingGains& gains, const std::optional<Hold>& held, double grip_z,
                            TipBending tip) noexcept;

/// The coupling as it stands: where its anchor is. The anchor slides so that the stretch never stores more than the
/// device can make felt, and the hands hold.
class Coupling {
public:
    Coupling(const CouplingGains& gains, const Handling& handling) noexcept;

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

    /// In air a hand takes its tool straight again: of what the anchor has slid, this share (0 … 1) goes back. Returns
    /// whether something is left.   [haptic, nonblocking]
    bool straighten(double share) noexcept;

    /// Lets the tool go about its shaft, or takes hold of it again (false): meanwhile its anchor there follows the
    /// handle and carries no torque. A damper of 1 % [assumed] is left, so that the solve has one answer.
    /// [haptic, nonblocking]
    void loosen_about_shaft(bool is_loose) noexcept { is_loose_ = is_loose; }

    /// What the stretch can give back to the hand [J], on the device's side: of a turn, as much as the device's own
    /// torques store.   [haptic, nonblocking]
    [[nodiscard]] double stored(const Pose& world_from_handle, const Pose& world_from_tool) const noexcept;
    [[nodiscard]] const CouplingGains& gains() const noexcept { return gains_; }
    /// Of the device [N], [N·m].
    [[nodiscard]] double force_limit() const noexcept { return force_share_ * gains_.force_limit; }
    [[nodiscard]] double torque_limit() const noexcept { return torque_share_ * gains_.torque_limit; }
    /// Of its motor about the shaft [N·m].
    [[nodiscard]] double shaft_limit() const noexcept { return torque_share_ * gains_.shaft.torque_limit; }
    [[nodiscard]] Vec3 grip() const noexcept { return grip_; }  ///< tool frame [m]
    [[nodiscard]] const Spring& spring() const noexcept { return spring_; }

private:
    [[nodiscard]] Vec3 stretch(const Pose& handle, const Pose& tool) const noexcept {  ///< tool frame
        return rotate(conjugate(tool.rotation), handle * centre() - tool * centre() - slip_);
    }
    [[nodiscard]] Quat twist(const Pose& handle, const Pose& tool) const noexcept {
        return conjugate(tool.rotation) * handle.rotation * rotation_slip_;
    }
    [[nodiscard]] Vec3 centre() const noexcept { return {0, 0, spring_.centre_z}; }
    /// On the tool [N], [N·m].
    [[nodiscard]] Split most_force() const noexcept { return force_limit() / gains_.force_scale; }
    [[nodiscard]] Split most_torque() const noexcept {
        if (held_) return torque_share_ * Split(held_->strength, held_->twist);
        const double across = torque_limit() / gains_.force_scale;
        return {across, gains_.shaft.is_driven() ? shaft_limit() / gains_.force_scale : across};
    }

    CouplingGains gains_;
    std::optional<Hold> held_;
    Vec3 grip_;
    Spring spring_;
    double force_share_ = 1.0, torque_share_ = 1.0;
    bool is_loose_ = false;  ///< about the shaft
    Vec3 slip_{};            ///< how far the anchor has slid, world frame [m]
    Quat rotation_slip_{1, 0, 0, 0};
};

}  // namespace kerf
