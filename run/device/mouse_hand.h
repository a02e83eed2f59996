// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "devices/simulated_hand/simulated_hand.h"
#include "run/device/aimed_hand.h"
#include "run/device/mouse_totals.h"

namespace kerf::run {

/// What a hand at a mouse feels of the tool in a tick.
struct TouchedTool {
    DeviceCommand command{};  ///< of the modelled device, on the hand
    Pose world_from_tool = identity_pose();
    double resistance = 0.0;     ///< [N] of the bone on the tool
    bool is_force_away = false;  ///< the force has faded after a fault
    bool has_thread = false;     ///< the tool is turned in
    bool is_realigning = false;  ///< the tool moves in the hand
    Vec3 lie{};                  ///< [m] from the tool to the handle without stretch, world frame
};

/// A simulated hand whose aim a mouse moves. So the run has a hand's feed and push, and the tool is never moved itself.
///
/// In air the aim moves at 30 mm/s at most [assumed]. In bone it moves at 1.5 times the step's planned feed at most,
/// and back out as in air. What the mouse did beyond that is remembered, but no more than 0.25 s of motion at that
/// speed [assumed]: a flick moves the tool for a quarter of a second.
///
/// The aim leads the tool by at most 3 mm. While the mouse moves along the shaft and bone resists, the hand leans: its
/// push grows with the lead and its duration, up to the arm's maximum push. The lean ends with a time constant of 0.1 s
/// when the mouse has not moved along the shaft for 0.25 s, and so does the lead along the shaft when it has been still
/// that long [assumed]. So with the mouse still, nothing moves on. Across the shaft the hand keeps the aim, without
/// leaning. More than 1 mm deep it forgets that lead with a time constant of 2 s, so that a hole that lies elsewhere is
/// not fought.
///
/// The mouse tilts the tool about its tip at 30 degrees per second at most, and only in air or up to 1 mm deep. It
/// turns a screw or tap by half a turn per second. In an operation whose wrist regrips, it turns back after the angle
/// of that wrist, as SimulatedHand does. Other tools turn about their axis only where they tilt.
class MouseHand {
public:
    /// @param totals  before the first tick
    MouseHand(const Arm& arm, const Pose& world_from_tool, const MouseTotals& totals, double dt);

    /// Begins a step.   [haptic, nonblocking]
    /// @param feed    [m/s] planned
    /// @param regrip  [rad] angle after which the wrist turns back without the screw or tap; 0: never
    void begin_step(double feed, double regrip) noexcept {
        feed_ = feed;
        regrip_ = regrip;
    }
    /// Takes over what the mouse has done since the last call. Ignores totals that are not finite.
    /// [haptic, nonblocking]
    void take(const MouseTotals& totals) noexcept;
    /// Drops what the mouse has done since the last call.   [haptic, nonblocking]
    void drop(const MouseTotals& totals) noexcept { seen_ = totals; }
    /// Advances by one tick. In periods that a clock misses, neither aim nor hand moves.   [haptic, nonblocking]
    void step(const TouchedTool& touched);
    /// Lets the hand take another tool.   [haptic, nonblocking]
    void take_tool() noexcept;

    /// Returns the pose of the hand, or the start pose.
    [[nodiscard]] Pose reported() const noexcept;
    /// Returns whether the wrist has released a screw or tap, to turn back.
    [[nodiscard]] bool is_regripping() const noexcept { return is_regripping_; }
    /// Returns the stretch of the arm: from the hand to its aim, with its lean [m], world frame.
    [[nodiscard]] Vec3 stretch() const noexcept { return aim_.position + lean_ * shaft() - hand_.reported().position; }

private:
    /// Time since the aim moved, since it moved along the shaft, and since the bone resisted [s].
    struct Since {
        double moved = 1.0, fed = 1.0, resisted = 1.0;
    };
    [[nodiscard]] bool is_in_bone() const noexcept;
    [[nodiscard]] bool is_deep() const noexcept;
    [[nodiscard]] Vec3 shaft() const noexcept { return rotate(tool_.rotation, {0, 0, 1}); }
    [[nodiscard]] double max_speed() const noexcept;
    void rest() noexcept;
    void follow_contact(const TouchedTool& touched) noexcept;
    void follow_slip(const TouchedTool& touched) noexcept;
    void turn(bool has_thread) noexcept;
    void tilt() noexcept;
    void push(Vec3 step) noexcept;

    simulated_hand::SimulatedHand hand_;
    Pose aim_;
    double max_push_, max_lead_, leaning_;  ///< [N], [m], [1/s] growth of the lean per lead
    double dt_;                             ///< [s]
    double feed_ = 1e-3, regrip_ = 0.0;     ///< [m/s], [rad]
    MouseTotals seen_;                      ///< totals that were taken over
    Vec3 left_{}, tilt_left_{};             ///< [m], [rad] that the mouse has moved and the aim has not
    double turn_left_ = 0.0;                ///< [rad]
    double lean_ = 0.0;                     ///< [m] along the shaft: additional stretch of the arm's spring
    double turned_ = 0.0;                   ///< [rad] of the wrist about the tool's z axis
    double grip_ = 0.0;                     ///< [rad] `turned_` when the wrist gripped last
    bool is_regripping_ = false;
    Since since_;
    Pose tool_;
    std::optional<Vec3> entry_{};  ///< where the tip met bone
    double depth_ = 0.0;           ///< [m] of the tip beyond it
    Vec3 shift_{};                 ///< [m] of the hand, by which it followed a tool that moved in it
    Vec3 lie_{};                   ///< of the last tick
    bool was_realigning_ = false;
};

}  // namespace kerf::run
