// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/haptics/law/solve.h"
#include "core/haptics/law/tool_grip.h"
#include "core/haptics/loop/device_record.h"

/// The spring and damper between the hand and the tool.
namespace kerf {

/// Stiffness and strength of the hand or hands that carry a tool. In bone newtons, the same on every device.
struct HandCompliance {
    double turn_stiffness = 0.0;   ///< [N·m/rad] of the wrist, at the grip
    double axial_stiffness = 0.0;  ///< [N/m] maximum along the shaft; a softer device's own stiffness applies
    double strength = 0.0;         ///< [N·m] about lines across the shaft; above it the tool turns in the hand
    double twist = 0.0;            ///< [N·m] strength about the shaft
    double damping_ratio = 0.5;    ///< with a handpiece of 0.5 kg [assumed]
};
/// A drill in one hand. Turn stiffness and twist are [assumed]; for the strength, measured maxima are 7 … 12 N·m. Every
/// device can render the axial stiffness.
inline constexpr HandCompliance one_hand{
    .turn_stiffness = 10.0, .axial_stiffness = 7.5e3, .strength = 7.0, .twist = 5.0};
/// A saw in two hands: arms of 5 N/mm, 150 mm apart, and two wrists [assumed].
inline constexpr HandCompliance two_hands{
    .turn_stiffness = 60.0, .axial_stiffness = 7.5e3, .strength = 20.0, .twist = 20.0};

/// Gains of a device's motor about the shaft, in device newtons. One encoder count changes the motor's torque by no
/// more than the motor's friction: half from the spring and half from the damper. So a hand at rest feels no count.
struct ShaftGains {
    double torque_limit = 0.0;  ///< [N·m]; 0: the device has no such motor
    double stiffness = 0.0;     ///< [N·m/rad] maximum
    double damping = 0.0;       ///< [N·m·s/rad] maximum, for the coupling and for the passivity controller separately
    double resolution = 0.0;    ///< [rad] of one count

    [[nodiscard]] bool is_driven() const noexcept { return torque_limit > 0.0; }
};

/// Coupling gains in device newtons. Divided by the force scale they are gains in bone newtons.
struct CouplingGains {
    double stiffness = 0.0;          ///< K_c [N/m]
    double damping = 0.0;            ///< B_c [N·s/m]
    double force_limit = 0.0;        ///< [N]
    double continuous_force = 0.0;   ///< [N] that the motors can make without end; 0: no such limit
    double continuous_torque = 0.0;  ///< [N·m] the same
    double torque_limit = 0.0;       ///< [N·m]
    bool has_torque = false;         ///< the device actuates torques; they count as energy given to the hand
    ShaftGains shaft{};              ///< of a device with a motor about the shaft alone
    double resolution = 0.0;         ///< [m] of one count of the device's encoders
    double spare_damping = 0.0;      ///< [N·s/m] maximum damping of the passivity controller
    double force_scale = 1.0;        ///< [–] device newtons per bone newton, one for force and torque
    double rotation_arm = 0.05;      ///< [m] K_rot = K arm², B_rot = B arm² [assumed]
    double release_damping = 0.0;    ///< B_x [N·s/m] between hand and tool at breakthrough (docs/design/tick.md)
    bool is_held = false;            ///< the tool is in one or two hands, as it declares; false: the handle clamps it
};

/// Returns the largest gains for a device whose forces arrive `latency` ticks late (0 … max_latency, asserted):
///
///     K_c = min(0.6 × largest stiffness of its record, 0.5 × stiffest wall that is stable on it),
///     B_c = min(0.5 × largest damping of its record, T (0.08 N / Δ − K_c)), at least 0,
///     B_x = min(0.15 s × K_c, 0.22 m/T)
///
/// with Δ one count of its encoders, m its mass at the handle and T = 1 ms. A motor about the shaft with friction τ and
/// counts of φ gets the stiffness τ/2φ and the damping T τ/2φ. The factors in B_c and B_x are judgements; all gains are
/// validated against S-01, S-02, S-06, S-15 and S-19 (docs/design/tick.md).
[[nodiscard]] CouplingGains gains_for(const DeviceRecord& device, double force_scale, int latency = 0) noexcept;

/// Returns the same gains for a tool in hands.   [any] pure.
[[nodiscard]] inline CouplingGains in_hands(CouplingGains gains) noexcept {
    gains.is_held = true;
    return gains;
}

/// Returns the largest force scale, at most 1, at which `work_force` [bone newtons] is rendered by at most 0.6 of the
/// device's continuous force.
[[nodiscard]] double force_scale_for(const DeviceRecord& device, double work_force) noexcept;

/// The coupling as one spring and damper, as the solve reads it. In bone newtons.
struct Spring {
    double centre_z = 0.0;               ///< [m] centre of compliance, tool frame: a force there does not turn the tool
    Split stiffness, damping;            ///< [N/m], [N·s/m]
    Split turn_stiffness, turn_damping;  ///< [N·m/rad], [N·m·s/rad]
};
/// Returns device, hands and shaft as one spring. Without `held` the handle clamps the tool. On a device without
/// torques only the wrist resists a turn, because turning the handle costs the hand no force. A motor about the shaft
/// limits the stiffness about it. With hands the springs in series have different damping ratios. Then one spring and
/// one damper represent them exactly at rest only.   [any] pure.
/// @param grip_z  [m] grip, tool frame
///
/// Source: docs/design/tick.md, "One spring".
[[nodiscard]] Spring combined_spring(const CouplingGains& gains, const std::optional<HandCompliance>& held,
                                     double grip_z, TipBending tip) noexcept;

/// The coupling at two poses, for a viewer. Tool frame, bone newtons.
struct CoupledPoses {
    Vec3 centre{}, grip{};            ///< [m] points of the tool: centre of compliance, and point that the hand grips
    Vec3 stretch{}, twist{};          ///< [m] at the centre, [rad]: from the tool towards the handle
    Split max_force{}, max_torque{};  ///< [N], [N·m] at which the anchor slides
};

/// State of the coupling: the pose of its anchor. The anchor slides when the spring's force or torque would exceed what
/// the device can render or the hands withstand.
class Coupling {
public:
    Coupling(const CouplingGains& gains, const ToolGrip& handling) noexcept;

    /// Sets the allowed fractions (0 … 1] of the force and torque limits: below 1 the anchor slides at smaller forces.
    /// After a fault the force returns by raising these fractions. Scaling the force itself would give out more energy
    /// than was put in. [haptic, nonblocking]
    void set_allowed_fractions(double of_force, double of_torque) noexcept {
        force_fraction_ = of_force;
        torque_fraction_ = of_torque;
    }

    /// Sets the coupling, the release damper, the hand's velocity and `dt` [s] of `out`. Leaves the channels,
    /// `following`, `inertia` and `previous_rate` unchanged.   [haptic, nonblocking]
    /// @param hand_rate  of the handle, world frame [m/s, rad/s]
    void hold(const Pose& world_from_handle, const Vec6& hand_rate, const Pose& world_from_tool, double dt,
              Balance& out) const noexcept;
    /// After a step, slides the anchor until the spring's force and torque are within their limits.
    /// [haptic, nonblocking]
    void slide(const Pose& world_from_handle, const Pose& world_from_tool) noexcept;
    /// Moves the anchor so that the stretch is zero at the present poses.   [haptic, nonblocking]
    void relax(const Pose& world_from_handle, const Pose& world_from_tool) noexcept;

    /// Moves the anchor back by this fraction (0 … 1) of its slip, as a hand realigns its tool in air. Returns
    /// whether some slip remains.   [haptic, nonblocking]
    bool straighten(double fraction) noexcept;
    /// Returns tool_from_handle without stretch: how the tool lies in the hand. The identity if the anchor never slid.
    /// [haptic, nonblocking]
    [[nodiscard]] Pose grasp(const Pose& world_from_tool) const noexcept;
    /// Returns the largest displacement of a point between tip and centre by the anchor's slip [m].
    /// [haptic, nonblocking]
    [[nodiscard]] double slip() const noexcept {
        return std::max(length(slip_), length(small_rotation_vector(rotation_slip_)) * std::abs(spring_.centre_z));
    }

    /// Releases the tool about its shaft, or grips it again (false). While released, the anchor about the shaft follows
    /// the handle and carries no torque. A damper of 1 % [assumed] remains, so that the solve has one solution.
    /// [haptic, nonblocking]
    void loosen_about_shaft(bool is_loose) noexcept { is_loose_ = is_loose; }

    /// Returns the energy that the stretch can give back to the hand [J], on the device's side of the force scale. Of a
    /// turn, only the energy stored by the device's own torques counts.   [haptic, nonblocking]
    [[nodiscard]] double stored(const Pose& world_from_handle, const Pose& world_from_tool) const noexcept;
    [[nodiscard]] const CouplingGains& gains() const noexcept { return gains_; }
    /// The device's limits times their allowed fractions [N], [N·m], device newtons.
    [[nodiscard]] double force_limit() const noexcept { return force_fraction_ * gains_.force_limit; }
    [[nodiscard]] double torque_limit() const noexcept { return torque_fraction_ * gains_.torque_limit; }
    /// Returns the limit of the device's motor about the shaft times its allowed fraction [N·m], device newtons.
    [[nodiscard]] double shaft_limit() const noexcept { return torque_fraction_ * gains_.shaft.torque_limit; }
    /// Returns how far the spring is stretched, and its limits.   [any]
    [[nodiscard]] CoupledPoses at(const Pose& world_from_handle, const Pose& world_from_tool) const noexcept {
        return {centre(),
                grip_,
                stretch(world_from_handle, world_from_tool),
                small_rotation_vector(twist(world_from_handle, world_from_tool)),
                max_force(),
                max_torque()};
    }
    [[nodiscard]] Vec3 grip() const noexcept { return grip_; }  ///< point that the hand grips, tool frame [m]
    [[nodiscard]] const Spring& spring() const noexcept { return spring_; }

private:
    /// Returns the spring's stretch at the centre, from the tool towards the handle, tool frame [m].
    [[nodiscard]] Vec3 stretch(const Pose& handle, const Pose& tool) const noexcept {
        return rotate(conjugate(tool.rotation), handle * centre() - tool * centre() - slip_);
    }
    [[nodiscard]] Quat twist(const Pose& handle, const Pose& tool) const noexcept {
        return conjugate(tool.rotation) * handle.rotation * rotation_slip_;
    }
    [[nodiscard]] Vec3 centre() const noexcept { return {0, 0, spring_.centre_z}; }
    /// The limits of the force and of the torque on the tool, in bone newtons [N], [N·m].
    [[nodiscard]] Split max_force() const noexcept { return force_limit() / gains_.force_scale; }
    [[nodiscard]] Split max_torque() const noexcept {
        if (held_) return torque_fraction_ * Split(held_->strength, held_->twist);
        const double across = torque_limit() / gains_.force_scale;
        return {across, gains_.shaft.is_driven() ? shaft_limit() / gains_.force_scale : across};
    }

    CouplingGains gains_;
    std::optional<HandCompliance> held_;
    Vec3 grip_;
    Spring spring_;
    double force_fraction_ = 1.0, torque_fraction_ = 1.0;
    bool is_loose_ = false;           ///< about the shaft
    Vec3 slip_{};                     ///< from the anchor to the handle, world frame [m]
    Quat rotation_slip_{1, 0, 0, 0};  ///< rotation that it has slid: handle_from_anchor
};

}  // namespace kerf
