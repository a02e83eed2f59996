// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "kerf/device.hpp"

/// A hand without hardware: an arm that holds a haptic device and carries out intent.
namespace kerf::simulated_hand {

/// The arm that holds the handle, and the handle itself. Device side.
struct Plant {
    double arm_mass = 0.554;        ///< [kg]     one fitted trial [van-beek-2015]
    double arm_damping = 6.45;      ///< [N·s/m]  same
    double arm_stiffness = 135.0;   ///< [N/m]    same
    double leaning = 135.0;         ///< [N/(m·s)] by which the push grows, for each metre of lag and second
    double device_mass = 0.075;     ///< [kg]
    double device_viscosity = 0.1;  ///< [N·s/m]
    double device_friction = 0.04;  ///< [N] Coulomb
    double resolution = 30e-6;      ///< [m] of one encoder count
    double turn_resolution = 0.0;   ///< [rad] of one count about the handle's z; 0: it has no such encoder
    bool asks_setpoint = false;  ///< the device closes the spring itself, 20 times a tick, instead of holding the force
};

/// Returns an arm whose stiffness and lean in bone do not depend on the device or its force scale: 5 N/mm, up to 600
/// N/m at the device, and 17 N for each millimetre of lag and second [assumed].   [any] pure.
[[nodiscard]] Plant in_bone(Plant plant, double force_scale) noexcept;

/// One leg of the way: to `target`, in a straight line. Without length it only turns.
struct Leg {
    Pose target = identity_pose();
    double speed = 10e-3;     ///< [m/s] aimed at
    double push = 0.0;        ///< [N] the most that reaches the tool, device side
    double stop_aside = 0.0;  ///< [m] beside the leg, where it sees the tip, at which it goes to the last leg; 0: never
    double turn = 0.0;        ///< [rad] about the handle's z, right-handed, from its start on; the leg ends with it
    double turning = 3.0;     ///< [rad/s] of that turn
    double torque = HUGE_VAL;        ///< [N·m] against the turn: where it feels more, it does not turn on
    double until_torque = HUGE_VAL;  ///< [N·m] against the turn: where it feels as much, the turn is over
    std::string until_event{};       ///< the turn is over where it feels this happen; empty: none
    double regrip = 0.0;             ///< [rad] after which it turns the wrist back without the tool; 0: never

    /// Whether the turn can end before its angle.
    [[nodiscard]] bool can_end_early() const noexcept { return until_torque < HUGE_VAL || !until_event.empty(); }
    /// Returns how long the wrist turns back, at least. [s]
    [[nodiscard]] double least_regripping() const noexcept;
};

/// What the hand sees and feels of the tool, whatever the device makes.
struct Felt {
    Pose world_from_tool = identity_pose();
    double torque = 0.0;     ///< [N·m] of the hand on the tool about its z, unscaled
    bool has_event = false;  ///< that which the leg waits for has just happened
};

struct Intent {
    std::vector<Leg> legs;
    double reaction = 0.15;  ///< [s] until the hand answers what it feels
};

/// An arm with an intent.
///
/// The mind moves a plan along the leg at the speed it aims at. The arm's spring pulls the handle to the plan; where
/// that is not enough the mind leans in, in proportion to the lag it sees and for as long as it sees it, up to `push`.
/// What the device's friction takes, the arm adds. The mind sees the tool's tip, one reaction time late, and never
/// writes its pose. When it sees the tip ahead of the plan it lets go: the lean is gone and the plan goes on from where
/// the tip is. A tip that it sees beside the leg it brings back, by its distance in a second. The wrist turns to its
/// aim and holds it, whatever it meets. A driver it turns on from there, as often as it takes. What it feels about the
/// driver's shaft reaches it one reaction time late as well.
///
/// A wrist has half a turn. With `regrip` it lets the driver go about the shaft after that angle, turns back at 2 rad/s
/// and takes hold again. It looks at the driver then, and turns on by what is left of the driver's own angle: what the
/// wrist gave way by is not lost.
class SimulatedHand {
public:
    SimulatedHand(const Plant& plant, const Intent& intent, const Pose& start, double dt);

    /// One tick under what the device is sent; what the encoders say then.
    Pose step(const DeviceCommand& command, const Felt& felt);
    /// The same with the tool's tip there [m] and nothing felt about the shaft.
    Pose step(const DeviceCommand& command, Vec3 tip) {
        return step(command, Felt{.world_from_tool = {tip, reported().rotation}});
    }
    /// The same in air, where the tip goes with the handle.
    Pose step(const DeviceCommand& command) { return step(command, reported().position); }
    /// The last answer of `step`, or the start.
    [[nodiscard]] Pose reported() const noexcept;
    [[nodiscard]] bool is_done() const noexcept { return leg_ >= intent_.legs.size(); }
    [[nodiscard]] std::size_t leg() const noexcept { return leg_; }
    /// Whether it has let the tool go about its shaft. It turns back only in the tick after it began, and turns on only
    /// in the tick after it ended.
    [[nodiscard]] bool is_regripping() const noexcept { return is_regripping_; }
    /// The event that ends the turn it is at; empty: none.
    [[nodiscard]] const std::string& awaited_event() const noexcept;

private:
    void think(const Felt& felt);
    /// Turns the driver on, or the wrist back; false where it waits.
    [[nodiscard]] bool turn(const Leg& leg, double felt_torque);
    void begin(std::size_t leg, Vec3 from, Vec3 tip);
    [[nodiscard]] Vec3 along() const noexcept;  ///< of the leg; nothing where it only turns

    Plant plant_;
    Intent intent_;
    double dt_;
    Vec3 position_, velocity_{};
    Quat rotation_;          ///< of the wrist
    double turned_ = 0.0;    ///< [rad] by which the driver is ahead of the wrist, about its z
    double plan_ = 0.0;      ///< [m] along the leg: where the mind would be
    double lean_ = 0.0;      ///< [m] along the leg: stretch of the arm's spring on top
    Vec3 beside_{};          ///< [m] how far it aims beside the leg, so that the tip is on it
    Vec3 leg_start_;         ///< where the leg before was to end
    double turn_end_ = 0.0;  ///< [rad] of `turned_`, in this leg
    double grip_ = 0.0;      ///< [rad] of `turned_`, where the wrist took hold
    bool is_regripping_ = false, is_turn_over_ = false;
    Quat driver_;                 ///< rotation of the tool in the tick before
    double driver_turned_ = 0.0;  ///< [rad] of the tool about its z since the beginning, many turns
    double driver_end_ = 0.0;     ///< [rad] of that, in this leg
    std::size_t leg_ = 0;
    bool turns_ = false;  ///< in this leg: it ends as planned, as a tip in a hole may not get there
    /// What was, and what was planned, one reaction time ago: rings.
    std::vector<Vec3> seen_;
    std::vector<double> planned_, felt_torque_;
    std::vector<bool> felt_event_;
    std::size_t seen_at_ = 0;
};

}  // namespace kerf::simulated_hand
