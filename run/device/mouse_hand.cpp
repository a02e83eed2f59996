// SPDX-License-Identifier: Apache-2.0
#include "run/device/mouse_hand.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace kerf::run {

namespace {

constexpr double air_speed = 30e-3;                 // [m/s] a hand that goes up to bone [assumed]
constexpr double bone_speed = 1.5;                  // [–] of the planned feed
constexpr double keep = 0.25;                       // [s] of motion that is remembered; of rest that ends a push
constexpr double spread = 20e-3;                    // [s] over which a sample of the mouse becomes motion
constexpr double max_ahead = 3e-3;                  // [m] as SimulatedHand's plan
constexpr double letting_go = 10.0;                 // [1/s] decay of a push [assumed]
constexpr double yielding = 0.5;                    // [1/s] decay of a lead across a hole, as of SimulatedHand
constexpr double noticed_force = 0.5;               // [N] of bone that resists [assumed]
constexpr double shallow = 1e-3;                    // [m] up to which a tool tilts
constexpr double away = 10e-3;                      // [m] across the hole: the tip has left it
constexpr double tilting = std::numbers::pi / 6.0;  // [rad/s]
constexpr double turning = std::numbers::pi;        // [rad/s]
constexpr double turning_back = 2.0;                // [rad/s] of a wrist that has released the tool
constexpr double aslant = 0.2;                      // [–] sine from which a motion counts as one along the shaft
constexpr double nothing = 1e-9;                    // [m], [rad]

/// Returns `v`, no longer than `max_length`.
Vec3 clamped(Vec3 v, double max_length) noexcept {
    const double size = length(v);
    return size > max_length ? (max_length / size) * v : v;
}

/// Takes from `left` what moves in a tick: spread over some ticks, and no faster than `speed` [1/s]. What exceeds
/// `keep` of motion is forgotten.
Vec3 take_step(Vec3& left, double speed, double dt) noexcept {
    left = clamped(left, keep * speed);
    const double fraction = length(left) > nothing ? dt / spread : 1.0;
    const Vec3 step = clamped(fraction * left, speed * dt);
    left = left - step;
    return step;
}

/// Returns a rotation about z without a jump of the quaternion's sign, which has a period of two turns.
Quat turned_about_z(double angle) noexcept {
    return quat_from_rotation_vector({0, 0, std::remainder(angle, 4.0 * std::numbers::pi)});
}

}  // namespace

MouseHand::MouseHand(const Arm& arm, const Pose& world_from_tool, const MouseTotals& totals, double dt)
    : hand_(arm.plant, {}, world_from_tool, dt),
      aim_(world_from_tool),
      max_push_(arm.max_push),
      max_lead_(arm.max_push / arm.plant.arm_stiffness),
      leaning_(arm.plant.leaning / arm.plant.arm_stiffness),
      dt_(dt),
      seen_(totals),
      tool_(world_from_tool) {}

void MouseHand::take(const MouseTotals& totals) noexcept {
    if (!is_finite(totals.moved) || !is_finite(totals.tilted) || !std::isfinite(totals.along + totals.turned)) return;
    const MouseTotals before = std::exchange(seen_, totals);
    left_ = left_ + (totals.moved - before.moved) + (totals.along - before.along) * shaft();
    tilt_left_ = tilt_left_ + (totals.tilted - before.tilted);
    turn_left_ += totals.turned - before.turned;
}

Pose MouseHand::reported() const noexcept {
    const Pose hand = hand_.reported();
    return {hand.position + shift_, turned_ == 0.0 ? hand.rotation : hand.rotation * turned_about_z(turned_)};
}

bool MouseHand::is_in_bone() const noexcept { return since_.resisted < keep; }
bool MouseHand::is_deep() const noexcept { return entry_ && depth_ > shallow; }

double MouseHand::max_speed() const noexcept {
    const bool is_outwards = -dot(left_, shaft()) > 0.7 * length(left_);
    return !is_in_bone() || is_outwards ? air_speed : std::min(air_speed, bone_speed * feed_);
}

void MouseHand::step(const TouchedTool& touched) {
    tool_ = touched.world_from_tool;
    follow_contact(touched);
    follow_slip(touched);
    if (touched.is_force_away) return rest();
    turn(touched.has_thread);
    tilt();
    push(take_step(left_, max_speed(), dt_));
    hand_.aim_at({aim_.position + lean_ * shaft(), aim_.rotation}, max_push_);
    static_cast<void>(hand_.step(touched.command));
}

void MouseHand::take_tool() noexcept {
    rest();
    is_regripping_ = was_realigning_ = false;
    grip_ = turned_;
    entry_.reset();
    depth_ = 0.0;
    since_.resisted = keep;
}

/// Stops where the hand is, without push.
void MouseHand::rest() noexcept {
    hand_.stop();
    aim_ = hand_.reported();
    left_ = tilt_left_ = {};
    lean_ = turn_left_ = 0.0;
}

/// Follows whether the tool is in bone, and how deep: the tip beyond the point where it met bone. A tool in its own
/// hole may meet none.
void MouseHand::follow_contact(const TouchedTool& touched) noexcept {
    const bool is_resisted = touched.resistance > noticed_force;
    since_.resisted = is_resisted ? 0.0 : since_.resisted + dt_;
    if (is_resisted && !entry_) entry_ = tool_.position;
    if (!entry_) return;
    const Vec3 beyond = tool_.position - *entry_;
    depth_ = dot(beyond, shaft());
    if (!is_in_bone() && (depth_ < 0.0 || length(beyond - depth_ * shaft()) > away)) entry_.reset();
}

/// Moves the hand by as much as a tool moves in it, so that the tool rests: a tool that was newly taken, or anchored
/// anew after a pause of the machine, moves back to the handle.
void MouseHand::follow_slip(const TouchedTool& touched) noexcept {
    if (touched.is_realigning && was_realigning_) shift_ = shift_ + (touched.lie - lie_);
    was_realigning_ = touched.is_realigning;
    lie_ = touched.lie;
}

void MouseHand::turn(bool has_thread) noexcept {
    turn_left_ = std::clamp(turn_left_, -keep * turning, keep * turning);
    if (is_regripping_) {
        is_regripping_ = turned_ != grip_;  // it turns on in the next tick
        turned_ += std::clamp(grip_ - turned_, -turning_back * dt_, turning_back * dt_);
        return;
    }
    if (!has_thread && is_deep()) turn_left_ = 0.0;
    const double fraction = std::abs(turn_left_) > nothing ? dt_ / spread : 1.0;
    const double step = std::clamp(fraction * turn_left_, -turning * dt_, turning * dt_);
    const double range = has_thread && regrip_ > 0.0 ? regrip_ : HUGE_VAL;
    const double end = std::clamp(turned_ + step, grip_ - range, grip_ + range);
    is_regripping_ = std::abs(step) > 0.0 && end == turned_;
    turned_ = end;
    turn_left_ -= step;
}

void MouseHand::tilt() noexcept {
    if (is_deep()) tilt_left_ = {};
    const Vec3 step = take_step(tilt_left_, tilting, dt_);
    if (step == Vec3{}) return;
    aim_.rotation = normalized(quat_from_rotation_vector(step) * aim_.rotation);
}

/// Moves the aim by a step, and lets the hand lean along the shaft. The aim leads the handle as the tool would hold it
/// without force: so it does not follow a tip that breaks through, nor grow while the tool stretches in the hand.
void MouseHand::push(Vec3 step) noexcept {
    const Vec3 shaft = this->shaft(), tool = tool_.position + lie_ - shift_, wanted = aim_.position + step - tool;
    const double decay = 1.0 - letting_go * dt_, step_along = dot(step, shaft);
    const bool is_along = std::abs(step_along) > std::max(nothing, aslant * length(step));
    since_.moved = length(step) > nothing ? 0.0 : since_.moved + dt_;
    since_.fed = is_along ? 0.0 : since_.fed + dt_;
    const bool has_stopped = since_.moved > keep && is_in_bone();
    const double along = dot(wanted, shaft), yield = is_deep() ? 1.0 - yielding * dt_ : 1.0;
    Vec3 ahead = ((has_stopped ? decay : 1.0) * along) * shaft + yield * (wanted - along * shaft);
    if (const double far = length(ahead); far > max_ahead) ahead = std::max(max_ahead / far, decay) * ahead;
    aim_.position = tool + ahead;

    if (since_.fed > keep || !is_in_bone() || along * lean_ < 0.0) lean_ *= decay;
    // Also while an opposite lean fades: otherwise a pull would keep a push from growing.
    if (is_in_bone() && is_along && along * step_along > 0.0) lean_ += leaning_ * dt_ * along;
    const double stretch = dot(aim_.position - hand_.reported().position, shaft);  // of the arm, without the lean
    lean_ = std::clamp(lean_, std::min(0.0, -max_lead_ - stretch), std::max(0.0, max_lead_ - stretch));
}

}  // namespace kerf::run
