// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/haptics/law/solve.h"
#include "core/haptics/law/tool_grip.h"
#include "core/haptics/loop/coupling.h"
#include "core/haptics/loop/force_gate.h"
#include "core/haptics/loop/hand_motion.h"
#include "core/haptics/loop/passivity.h"
#include "core/haptics/loop/tick_result.h"

namespace kerf {

/// The hand's side of the loop: the hand's motion, the coupling to the tool, the passivity guard and the force gate.
class HandPort {
public:
    HandPort(const CouplingGains& gains, const ToolGrip& handling, const Pose& start);

    /// Takes up another tool at this pose. The coupling has another spring and stores nothing.   [main] between ticks
    void take_tool(const ToolGrip& handling, const Pose& world_from_tool) noexcept;
    void loosen_about_shaft(bool is_loose) noexcept { coupling_.loosen_about_shaft(is_loose); }

    /// Reads a device sample and balances the energy since the last one. `kinetic_energy` [J] is the tool's, bone side.
    /// Returns false if nothing may follow from the hand's motion: see `HandMotion::take`.   [haptic, nonblocking]
    [[nodiscard]] bool read(const DeviceSample& sample, const Pose& world_from_tool, double kinetic_energy,
                            double dt) noexcept;
    /// Reads a device sample for a tool that is rigid to the hand.   [haptic, nonblocking]
    void read_direct(const DeviceSample& sample, double dt) noexcept;

    [[nodiscard]] const Pose& pose() const noexcept { return motion_.pose(); }
    /// Returns the hand's pose at the end of one part of the tick; `part` counts from 1.   [haptic, nonblocking]
    [[nodiscard]] Pose pose_after(int part, int parts) const noexcept;

    /// Writes the coupling's part of a balance for a step of `dt` [s].   [haptic, nonblocking]
    void couple(const Pose& world_from_handle, const Pose& world_from_tool, double dt,
                Balance& balance) const noexcept {
        coupling_.hold(world_from_handle, motion_.rate(), world_from_tool, dt, balance);
    }
    /// Adds the coupling's wrenches for a solved motion with a weight (0 … 1), which is the fraction of the tick that
    /// it lasts.   [haptic, nonblocking]
    void add_wrenches(const Balance& balance, const Motion& motion, double weight, const Pose& world_from_tool,
                      TickResult& result) const noexcept;
    /// Credits the hand with the work that the tool's motor does in a step of `dt` [s].   [haptic, nonblocking]
    void credit_motor(const Balance& balance, const Motion& motion, double dt) noexcept;
    /// Slides the coupling's anchor after the last step of a tick.   [haptic, nonblocking]
    void slide(const Pose& world_from_tool) noexcept { coupling_.slide(pose(), world_from_tool); }
    /// Drops the stretch of the coupling.   [haptic, nonblocking]
    void release_fraction(const Pose& world_from_tool) noexcept { coupling_.release_fraction(pose(), world_from_tool); }
    /// Straightens a tool that was just taken up, while nothing resists it.   [haptic, nonblocking]
    void straighten_new_tool(double dt) noexcept;

    [[nodiscard]] bool is_gate_closed() const noexcept { return gate_.is_closed_or_closing(); }
    /// Steps the force gate and adds its events.   [haptic, nonblocking]
    void gate(bool is_steady, const Pose& world_from_tool, double dt, TickResult& result) noexcept;
    /// Writes the command to the device, and the force limits of the next tick.   [haptic, nonblocking]
    void command(const Pose& world_from_tool, double dt, TickResult& result) noexcept;
    /// Writes the command of a tool that is rigid to the hand: the wrench of the bone, clamped.   [haptic, nonblocking]
    void command_direct(TickResult& result) noexcept;

    [[nodiscard]] double force_scale() const noexcept { return coupling_.gains().force_scale; }
    [[nodiscard]] const PassivityGuard& passivity() const noexcept { return guard_; }
    /// Returns the energy that the coupling would return to a hand at a pose [J], device side.
    [[nodiscard]] double stored_at(const Pose& world_from_handle, const Pose& world_from_tool) const noexcept {
        return coupling_.stored(world_from_handle, world_from_tool);
    }

private:
    [[nodiscard]] Vec3 torque_for_device(Vec3 torque_on_hand, const Pose& world_from_tool, double dt) noexcept;
    void command_coupled(const Pose& world_from_tool, double dt, TickResult& result, Vec6& wrench) noexcept;

    HandMotion motion_;
    Pose last_pose_;  ///< at the end of the tick before
    Coupling coupling_;
    PassivityGuard guard_;
    ForceGate gate_;
    Vec6 commanded_{};          ///< the last command: on the hand, device newtons
    Vec6 before_fault_{};       ///< command that the closing gate fades
    double supplied_ = 0.0;     ///< [J] work of the tool's motor in the last tick, device side
    bool is_tool_new_ = false;  ///< the hand has not yet straightened the tool that it took up
};

}  // namespace kerf
