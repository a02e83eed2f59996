// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "run/clock/tick_clock.h"
#include "run/device/mouse_totals.h"
#include "run/run_observer.h"
#include "run/scene.h"

namespace kerf::test {

/// A person at a mouse who carries out a rehearsal: they see the tool, its depth and the force in the ticks of the run,
/// and move the mouse 60 times a second. Only totals reach the run.
///
/// They move towards the end of each leg at its speed, slower near it, and bring the tip back onto the leg. They feed
/// so that the bone's resistance stays below the leg's push, and press the key of the next action at the end
/// of a leg that has one.
class ScriptedMouse final : public run::RunObserver {
public:
    /// Pre: `scene` and `box` outlive this object.
    /// @param off  [m] by which the person misses the plan, world frame
    ScriptedMouse(const run::Scene& scene, run::MouseBox& box, const std::string& rehearsal = "", Vec3 off = {})
        : scene_(&scene),
          box_(&box),
          path_(&run::rehearsal_of(scene.procedure, rehearsal).path),
          plan_(run::plan_of(run::rehearsal_of(scene.procedure, rehearsal), scene)) {
        plan_.start.position = plan_.start.position + off;
        for (auto& leg : plan_.intent.legs) leg.target.position = leg.target.position + off;
        totals_.is_driving = true;
        from_ = plan_.start.position;
        if (!plan_.inputs.front().empty()) press();
        box_->put(totals_);
    }

    void on_event(const session::EventRow& event) override {
        has_event_ |= leg_ < plan_.intent.legs.size() && event.id == plan_.intent.legs[leg_].until_event;
    }
    void on_tick(const session::TickRow& row) override {
        turned_ += small_rotation_vector(conjugate(tool_.rotation) * row.world_from_tool.rotation).z;
        tool_ = row.world_from_tool;
        if (row.tick == 0) turned_ = 0.0;
        force_ = 0.95 * force_ + 0.05 * length(linear(row.modelled));
        if (row.tick * 60 / 1000 == (row.tick + 1) * 60 / 1000) return;  // no sample in this tick
        velocity_ = 0.7 * velocity_ + (0.3 / dt) * (tool_.position - seen_at_);
        seen_at_ = tool_.position;
        see_tick(row);
        box_->put(totals_);
    }
    /// Returns the number of legs that were completed.
    [[nodiscard]] std::size_t legs_done() const noexcept { return leg_; }
    [[nodiscard]] std::size_t legs() const noexcept { return plan_.intent.legs.size(); }

private:
    static constexpr double dt = 1.0 / 60.0;                                 // [s]
    static constexpr double centred = 0.15e-3;                               // [m] before the tip meets bone
    static constexpr double arrived = 0.1e-3, tilted = 0.02, turned = 0.01;  // [m], [rad]
    static constexpr double settling = 0.1, straightening = 0.5;             // [s]
    static constexpr double noticed = 0.5e-3;                                // [m]
    static constexpr double ending = 3e-3;                                   // [m] before the end of a leg
    static constexpr double gently = 0.35, more_gently = 0.25;  // [–] of the push there; of a drill that turns
    static constexpr double sawing = 15.0;                      // [N] with which a saw still cuts
    static constexpr double arm = 5e3, correcting_push = 0.2;   // [N/m] of the hand in bone, [s]
    static constexpr double correcting = 0.5;                   // [1/s] of a tip in bone
    static constexpr double fastest = 30e-3, tilting = 0.4;     // [m/s], [rad/s]
    static constexpr double hand_turning = std::numbers::pi;    // [rad/s]
    static constexpr int pressing = 20;                         // samples for which the hand waits after a press

    void press() noexcept {
        ++totals_.actions;
        waits_ = pressing;
    }
    void see_tick(const session::TickRow& row) {
        if (waits_ > 0) {
            --waits_;
            return;
        }
        if (leg_ == plan_.intent.legs.size()) return;
        const simulated_hand::Leg& leg = plan_.intent.legs[leg_];
        const Vec3 off = leg.target.position - tool_.position;
        const Vec3 path = leg.target.position - from_;
        const Vec3 along = length(path) > 0.0 ? normalized(path) : Vec3{};
        const double left = dot(off, along);
        const Vec3 aside = off - left * along;
        const Vec3 tilt = row.depth > 0.0 || leg.turn != 0.0 ? Vec3{} : tilt_to(leg.target.rotation);
        if (has_arrived(leg, left, aside, tilt, row)) return next();

        double push = leg.push / scene_->gains.force_scale;
        if (is_along_shaft(along) && is_stopping(leg, along, left, length(path))) push = last_push(push, row);
        double speed = std::min({leg.speed, fastest, std::max(0.0, left) / settling});
        if (leg.turn != 0.0) speed = turn(leg, row);
        if (left < 0.0) speed = left / settling;
        if (speed > 0.0 && push > 0.0)
            speed = std::clamp(speed_of_push(push, along), leg.turn != 0.0 ? 0.0 : -speed, speed);
        move(dt * speed * along + dt * correction(aside, along, row.depth > 0.0));
        totals_.tilted = totals_.tilted + clamped(dt / straightening * tilt, tilting * dt);
    }
    /// Returns the speed of the mouse with which the bone's resistance reaches a force: that of the tool, and more or
    /// less while the hand stretches.
    [[nodiscard]] double speed_of_push(double force, Vec3 along) const noexcept {
        return dot(velocity_, along) + (force - force_) / (arm * correcting_push);
    }
    /// Returns the force before an end behind which the tool would plunge [N].
    [[nodiscard]] double last_push(double push, const session::TickRow& row) const {
        const bool is_saw = scene_->tool((*path_)[leg_ + 1].step).outline.whole.is_prism();
        const double part = (row.power_drive > 0.0 ? more_gently : gently) * push;
        return is_saw ? std::min(push, std::max(sawing, part)) : part;
    }
    [[nodiscard]] bool is_along_shaft(Vec3 along) const noexcept {
        return std::abs(dot(along, rotate(tool_.rotation, {0, 0, 1}))) > 0.5;
    }
    /// Returns whether the tool nears the end of a leg after which it goes no farther.
    [[nodiscard]] bool is_stopping(const simulated_hand::Leg& leg, Vec3 along, double left,
                                   double length_of_leg) const {
        if (leg.turn != 0.0 || left >= ending || length_of_leg <= ending) return false;
        const auto& legs = plan_.intent.legs;
        return leg_ + 1 == legs.size() || dot(legs[leg_ + 1].target.position - leg.target.position, along) < ending;
    }
    /// Returns the velocity that brings the tip back onto the leg [m/s]. A hole that is only a little off its axis is
    /// left so.
    [[nodiscard]] Vec3 correction(Vec3 aside, Vec3 along, bool is_in_bone) const noexcept {
        if (!is_in_bone) return clamped((1.0 / settling) * aside, fastest);
        const Vec3 seen = is_along_shaft(along) && length(aside) < noticed ? Vec3{} : aside;
        return correcting * seen;
    }
    [[nodiscard]] bool has_arrived(const simulated_hand::Leg& leg, double left, Vec3 aside, Vec3 tilt,
                                   const session::TickRow& row) {
        if (leg.turn != 0.0 && !leg.can_end_early() && left < 0.0) return true;
        if (leg.turn != 0.0)
            return has_event_ || std::abs(turned_ - turned_from_) >= std::abs(leg.turn) - turned ||
                   std::copysign(1.0, leg.turn) * row.torque >= leg.until_torque;
        const bool is_on_leg = row.depth > 0.0 || length(aside) < centred;
        return left < arrived && is_on_leg && length(tilt) < tilted;
    }
    void next() {
        from_ = plan_.intent.legs[leg_].target.position;
        ++leg_;
        turned_from_ = turned_;
        has_event_ = false;
        if (!plan_.inputs[leg_].empty()) press();
    }
    /// Turns the tool. Returns the speed with which the hand follows the thread [m/s].
    double turn(const simulated_hand::Leg& leg, const session::TickRow& row) {
        const double sign = std::copysign(1.0, leg.turn);
        if (sign * row.torque > leg.torque) return 0.0;
        const double turning = std::min(leg.turning, hand_turning);
        totals_.turned += sign * dt * turning;
        return leg.speed * turning / leg.turning;
    }
    /// Returns the rotation that brings the tool to `rotation` [rad]. Of a tool that is turned, only its axis counts.
    [[nodiscard]] Vec3 tilt_to(Quat rotation) const noexcept {
        if (scene_->tool((*path_)[leg_ + 1].step).outline.has_thread())
            return small_rotation_vector(quat_between(rotate(tool_.rotation, {0, 0, 1}), rotate(rotation, {0, 0, 1})));
        return small_rotation_vector(rotation * conjugate(tool_.rotation));
    }
    /// Moves the aim: along the tool's axis with the wheel, and across it with the mouse.
    void move(Vec3 by) noexcept {
        const Vec3 shaft = rotate(tool_.rotation, {0, 0, 1});
        totals_.along += dot(by, shaft);
        totals_.moved = totals_.moved + (by - dot(by, shaft) * shaft);
    }
    [[nodiscard]] static Vec3 clamped(Vec3 v, double max_length) noexcept {
        return length(v) > max_length ? (max_length / length(v)) * v : v;
    }

    const run::Scene* scene_;
    run::MouseBox* box_;
    const std::vector<documents::Waypoint>* path_;
    run::HandPlan plan_;
    run::MouseTotals totals_;
    Pose tool_ = identity_pose();
    Vec3 from_{}, seen_at_{}, velocity_{};     ///< [m], [m/s] of the tool
    double force_ = 0.0;                       ///< [N] of the bone, as a plot of the last 20 ms shows it
    double turned_ = 0.0, turned_from_ = 0.0;  ///< [rad] of the tool, and at the start of the leg
    bool has_event_ = false;
    std::size_t leg_ = 0;
    int waits_ = 0;
};

/// A clock that misses no period.
class PunctualClock final : public run::TickClock {
public:
    [[nodiscard]] std::uint32_t wait() noexcept override { return 0; }
};

}  // namespace kerf::test
