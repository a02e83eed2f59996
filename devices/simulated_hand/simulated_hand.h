// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kerf/device.hpp"

/// A simulated hand without hardware: an arm that grips a haptic device and follows an intent.
namespace kerf::simulated_hand {

/// The arm and the device's handle that it grips. Device newtons.
struct Plant {
    double arm_mass = 0.554;        ///< [kg]     one fitted trial [van-beek-2015]
    double arm_damping = 6.45;      ///< [N·s/m]  same
    double arm_stiffness = 135.0;   ///< [N/m]    same
    double leaning = 135.0;         ///< [N/(m·s)] growth of the push, per metre of lag and second
    double device_mass = 0.075;     ///< [kg]
    double device_viscosity = 0.1;  ///< [N·s/m]
    double device_friction = 0.04;  ///< [N] Coulomb
    double resolution = 30e-6;      ///< [m] of one encoder count
    double turn_resolution = 0.0;   ///< [rad] of one count about the handle's z axis; 0: no such encoder
    /// The device closes the spring itself, 20 times a tick. Otherwise it keeps the force constant for a tick.
    bool renders_setpoint = false;
};

/// Returns an arm whose stiffness and lean in bone do not depend on the device or its force scale: 5 N/mm, but at most
/// 600 N/m at the device, and 17 N per millimetre of lag and second [assumed].   [any] pure.
[[nodiscard]] Plant in_bone(Plant plant, double force_scale) noexcept;

/// One leg of the path: straight to `target`. A leg without length only turns.
struct Leg {
    Pose target = identity_pose();
    double speed = 10e-3;  ///< [m/s] intended
    double push = 0.0;     ///< [N] maximum force on the tool, device newtons
    /// [m] seen distance of the tip from the leg at which the hand skips to the last leg; 0: never.
    double skip_distance = 0.0;
    double turn = 0.0;  ///< [rad] about the handle's z axis, right-handed, from the leg's start; the leg ends with it
    double turning = 3.0;  ///< [rad/s] of that turn
    /// [N·m] resisting torque above which the turn pauses.
    double torque = HUGE_VAL;
    double until_torque = HUGE_VAL;  ///< [N·m] resisting torque that ends the turn
    std::string until_event{};       ///< id of an event that ends the turn; empty: none
    double regrip = 0.0;             ///< [rad] angle after which the wrist turns back without the tool; 0: never

    /// Returns whether the turn can end before its angle.
    [[nodiscard]] bool can_end_early() const noexcept { return until_torque < HUGE_VAL || !until_event.empty(); }
    /// Returns the minimum time that the wrist needs to turn back in this leg [s].
    [[nodiscard]] double min_regrip_time() const noexcept;
};

/// Pose, torque and events of the tool that the hand sees and feels, whatever the device renders.
struct SensedTool {
    Pose world_from_tool = identity_pose();
    double torque = 0.0;  ///< [N·m] of the hand on the tool about its z, unscaled
    /// The hand keeps its aim: a force on it has faded after a fault or a pause and is not yet back, or it waits for
    /// what it requested.
    bool keeps_aim = false;
    bool has_event = false;  ///< the event that ends the leg's turn has just happened
};

struct Intent {
    std::vector<Leg> legs;
    double reaction = 0.15;  ///< [s] delay between sensing and reaction
};

/// A simulated arm that follows an intent.
///
/// A plan moves along the leg at the intended speed. The arm's spring pulls the handle towards the plan. If the tip
/// lags, the lean grows in proportion to the lag and its duration, up to `push`. The arm adds the force that the
/// device's friction takes.
///
/// The hand sees the tool's tip with a delay of one reaction time, and never writes the tool's pose. If the tip runs
/// ahead of the plan, the lean decays and the plan continues from the tip. A tip off the leg is brought back at a
/// speed of its distance per second, and that correction is forgotten with a time constant of 2 s [assumed]. So a hole
/// that lies elsewhere is not fought ever harder. The wrist turns to its target rotation and keeps it, whatever the
/// resistance. A driver turns on from there, as often as needed. The torque about the driver's shaft is delayed by one
/// reaction time, too.
///
/// While a force is lost, the caller lets the hand keep its aim: the fault is over before a person reacts.
///
/// With `aim_at`, the caller moves the aim, and the hand follows no leg.
///
/// A wrist has half a turn. With `regrip` it releases the driver about the shaft after that angle, turns back at 2
/// rad/s and grips it again. It then turns on by the remaining angle of the driver itself, so compliance of the wrist
/// loses no angle.
class SimulatedHand {
public:
    SimulatedHand(const Plant& plant, const Intent& intent, const Pose& start, double dt);

    /// Advances by one tick under the force of the device. Returns the pose that the encoders report then.
    Pose step(const DeviceCommand& command, const SensedTool& felt);
    /// Advances by one tick with the tool's tip at `tip` [m] and no torque about the shaft.
    Pose step(const DeviceCommand& command, Vec3 tip) {
        return step(command, SensedTool{.world_from_tool = {tip, reported().rotation}});
    }
    /// Advances by one tick in air, where the tip moves with the handle.
    Pose step(const DeviceCommand& command) { return step(command, reported().position); }
    /// Aims with the handle at a pose, instead of the legs and without their delay: the arm's spring pulls towards it
    /// with `max_push` [N] at most, and the wrist turns to it. Ignores a pose or push that is not finite.
    void aim_at(const Pose& aim, double max_push) noexcept;
    /// Stops the arm where it is.
    void stop() noexcept { velocity_ = {}; }
    /// Takes the tool as it now lies in the hand (handle_from_tool without stretch): after a pause or a fault the
    /// coupling is anchored anew, and the tool is no longer where the handle is. From then on the hand aims with the
    /// tip, as a person does who sees it, and corrects the tool's tilt at 3 degrees per second. Of a tool that the hand
    /// turns, only the distance along the shaft counts.
    void regrasp(const Pose& handle_from_tool);
    /// Returns the last result of `step`, or the start pose.
    [[nodiscard]] Pose reported() const noexcept;
    [[nodiscard]] bool is_done() const noexcept { return leg_ >= intent_.legs.size(); }
    [[nodiscard]] std::size_t leg() const noexcept { return leg_; }
    /// Returns whether the wrist has released the tool about its shaft. It turns back from the next tick on, and turns
    /// on again only in the tick after it has gripped.
    [[nodiscard]] bool is_regripping() const noexcept { return is_regripping_; }
    /// Returns the id of the event that ends the present turn; empty: none.
    [[nodiscard]] const std::string& awaited_event() const noexcept;

private:
    struct Aim {
        Pose pose;
        double max_push;  ///< [N]
    };
    /// Returns the aim of the present leg.
    [[nodiscard]] Aim aim_of_leg() const noexcept;
    void think(const SensedTool& felt);
    /// Turns the driver on, or the wrist back. Returns false while it waits.
    [[nodiscard]] bool turn(const Leg& leg, double felt_torque);
    void begin(std::size_t leg, Vec3 from, Vec3 tip);
    [[nodiscard]] Vec3 along() const noexcept;  ///< unit, of the leg; zero if it only turns
    [[nodiscard]] bool is_turned_to(Quat wrist) const noexcept;
    /// Returns the wrist's rotation at which the tool has the target rotation of a leg.
    [[nodiscard]] Quat wrist_at_end(const Leg& leg) const noexcept {
        return leg.target.rotation * conjugate(corrected_tilt_);
    }

    Plant plant_;
    Intent intent_;
    double dt_;
    std::optional<Aim> aim_{};  ///< set: the hand follows it, and no leg
    Vec3 position_, velocity_{};
    Quat rotation_;                    ///< of the wrist
    double turned_ = 0.0;              ///< [rad] turn of the driver relative to the wrist, about its z axis
    double plan_ = 0.0;                ///< [m] along the leg: planned position
    double lean_ = 0.0;                ///< [m] along the leg: additional stretch of the arm's spring
    Vec3 offset_{};                    ///< [m] offset of the aim from the leg that brings the tip onto it
    Vec3 leg_start_;                   ///< planned end of the last leg
    Pose grasp_ = identity_pose();     ///< handle_from_tool: how the tool lies in the hand
    Quat corrected_tilt_{1, 0, 0, 0};  ///< the part of its rotation that the wrist allows for
    double turn_end_ = 0.0;            ///< [rad] `turned_` at the end of this leg
    double grip_ = 0.0;                ///< [rad] `turned_` when the wrist gripped last
    bool is_regripping_ = false, is_turn_over_ = false;
    Quat driver_;                 ///< rotation of the tool in the last tick
    double driver_turned_ = 0.0;  ///< [rad] turn of the tool about its z axis since the start, over many turns
    double driver_end_ = 0.0;     ///< [rad] `driver_turned_` at the end of this leg
    std::size_t leg_ = 0;
    /// The wrist turns in this leg, so the leg ends with the plan: a tip in a hole may not reach its end.
    bool turns_ = false;
    /// Rings over one reaction time: seen tips, plans and felt loads.
    std::vector<Vec3> seen_;
    std::vector<double> planned_, felt_torque_;
    std::vector<bool> felt_event_;
    std::size_t seen_at_ = 0;
};

}  // namespace kerf::simulated_hand
