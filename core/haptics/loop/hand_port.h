// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/haptics/law/solve.h"
#include "core/haptics/law/tool_grip.h"
#include "core/haptics/loop/coupling.h"
#include "core/haptics/loop/force_gate.h"
#include "core/haptics/loop/hand_motion.h"
#include "core/haptics/loop/motor_heat.h"
#include "core/haptics/loop/passivity.h"
#include "core/haptics/loop/tick_result.h"

namespace kerf {

/// The hand's side of the loop: the hand's motion, the coupling to the tool, the passivity guard and the force gate.
class HandPort {
public:
    HandPort(const CouplingGains& gains, const ToolGrip& handling, const Pose& start);

    /// Takes up another tool at this pose: makes its coupling, without stretch, and resets the energy of the passivity
    /// guard.   [main] between ticks
    void take_tool(const ToolGrip& handling, const Pose& world_from_tool) noexcept;
    void loosen_about_shaft(bool is_loose) noexcept { coupling_.loosen_about_shaft(is_loose); }

    /// Reads a device sample and updates the passivity guard for the hand's motion since the last one. Returns false,
    /// and leaves the guard unchanged, if that motion is unknown: see `HandMotion::take`.   [haptic, nonblocking]
    /// @param kinetic_energy  [J] of the tool, bone side
    [[nodiscard]] bool read(const DeviceSample& sample, const Pose& world_from_tool, double kinetic_energy,
                            double dt) noexcept;
    /// Does the same as `read` for a tool that is rigid to the hand: no spring stores energy.   [haptic, nonblocking]
    void read_direct(const DeviceSample& sample, double dt) noexcept;

    [[nodiscard]] const Pose& pose() const noexcept { return motion_.pose(); }
    /// Returns the hand's pose at the end of one part of the tick; `part` counts from 1.   [haptic, nonblocking]
    [[nodiscard]] Pose pose_after(int part, int parts) const noexcept;

    /// Writes the coupling into a balance for a step of `dt` [s]: see `Coupling::hold`.   [haptic, nonblocking]
    void couple(const Pose& world_from_handle, const Pose& world_from_tool, double dt,
                Balance& balance) const noexcept {
        coupling_.hold(world_from_handle, motion_.rate(), world_from_tool, dt, balance);
    }
    /// Returns the coupling at the hand's last pose: see `Coupling::at`.   [any]
    [[nodiscard]] CoupledPoses coupled(const Pose& world_from_tool) const noexcept {
        return coupling_.at(pose(), world_from_tool);
    }
    /// Adds the coupling's wrenches on the hand and the hand's power at a solved motion to the result, times `weight`:
    /// the fraction of the tick that the motion lasts (0 … 1).   [haptic, nonblocking]
    void add_wrenches(const Balance& balance, const Motion& motion, double weight, const Pose& world_from_tool,
                      TickResult& result) const noexcept;
    /// Adds the positive work of the balance's `following` load in a step of `dt` [s] to the energy that the device may
    /// give back. The tool's motor supplies it.   [haptic, nonblocking]
    void credit_motor(const Balance& balance, const Motion& motion, double dt) noexcept;
    /// Slides the coupling's anchor after the last step of a tick.   [haptic, nonblocking]
    void slide(const Pose& world_from_tool) noexcept { coupling_.slide(pose(), world_from_tool); }
    /// Sets the stretch of the coupling to zero.   [haptic, nonblocking]
    void relax(const Pose& world_from_tool) noexcept { coupling_.relax(pose(), world_from_tool); }
    /// Moves the anchor of a tool that was newly taken, or anchored anew after a fault, towards the handle: with a time
    /// constant of 0.3 s, and after a fault with at most 10 mm/s. To be called in each tick of `dt` [s] in which no
    /// channel resists the tool.   [haptic, nonblocking]
    void realign(double dt) noexcept;
    /// Returns whether the anchor has not yet reached the handle.
    [[nodiscard]] bool is_realigning() const noexcept { return is_realigning_; }
    /// Returns tool_from_handle without stretch.   [haptic, nonblocking]
    [[nodiscard]] Pose grasp(const Pose& world_from_tool) const noexcept { return coupling_.grasp(world_from_tool); }

    [[nodiscard]] bool is_gate_closed() const noexcept { return gate_.is_closed_or_closing(); }
    /// Steps the force gate, adds its events, and sets the coupling's stretch to zero while the gate is closed or
    /// closing. `is_steady`: what `read` returned.   [haptic, nonblocking]
    void gate(bool is_steady, const Pose& world_from_tool, double dt, TickResult& result) noexcept;
    /// Writes the device's command to `result`, and sets the coupling's limits for the next tick.
    /// [haptic, nonblocking]
    void command(const Pose& world_from_tool, double dt, TickResult& result) noexcept;
    /// Writes the command for a tool that is rigid to the hand: the wrench of the bone, clamped to the device's limits.
    /// [haptic, nonblocking]
    void command_direct(double dt, TickResult& result) noexcept;

    [[nodiscard]] double force_scale() const noexcept { return coupling_.gains().force_scale; }
    [[nodiscard]] const PassivityGuard& passivity() const noexcept { return guard_; }
    /// Returns the energy that the coupling could give back to the hand at these poses [J], device side.
    [[nodiscard]] double stored_at(const Pose& world_from_handle, const Pose& world_from_tool) const noexcept {
        return coupling_.stored(world_from_handle, world_from_tool);
    }

private:
    [[nodiscard]] Vec3 torque_for_device(Vec3 torque_on_hand, const Pose& world_from_tool, double dt) noexcept;
    void follow_heat(double dt, TickResult& result) noexcept;
    void command_coupled(const Pose& world_from_tool, double dt, TickResult& result, Vec6& wrench) noexcept;

    HandMotion motion_;
    Pose last_pose_;  ///< of the hand in the previous tick
    Coupling coupling_;
    PassivityGuard guard_;
    ForceGate gate_;
    MotorHeat force_heat_, torque_heat_;
    Vec6 commanded_{};                 ///< the last command: on the hand, device newtons
    Vec6 before_fault_{};              ///< command that the closing gate fades
    double supplied_ = 0.0;            ///< [J] work of the tool's motor since the last `read`, device side
    bool is_realigning_ = false;       ///< the tool is new or anchored anew, and not yet straight in the hand
    bool was_anchored_again_ = false;  ///< after a fault, since the tool was taken
};

}  // namespace kerf
