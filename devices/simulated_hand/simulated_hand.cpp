// SPDX-License-Identifier: Apache-2.0
#include "simulated_hand.h"

#include <algorithm>
#include <cmath>

namespace kerf::simulated_hand {

namespace {

constexpr int substeps = 20;          // of the plant per tick
constexpr double leaning_rate = 1.0;  // [1/s] lean per lag and second: slow enough for a reaction of 0.3 s [assumed]
constexpr double letting_go = 10.0;   // [1/s] how quickly the lean goes when the handle runs ahead [assumed]
constexpr double let_go = 0.2e-3;     // [m] of lean left: from then on it plans on from where the handle is [assumed]
constexpr double patience = 3e-3;     // [m] of lag the plan lets build up before it waits [assumed]
constexpr double surprise = 0.5e-3;   // [m] ahead of the plan that makes it let go [assumed]
constexpr double arrived = 0.2e-3;    // [m] short of a leg's end that counts as there [assumed]

constexpr double turning = 1.0;  // [rad/s] of the wrist [assumed]

/// From one rotation towards another, by an angle at most [rad].
Quat turned_towards(Quat from, Quat to, double most) {
    if (from.w * to.w + from.x * to.x + from.y * to.y + from.z * to.z < 0.0) to = {-to.w, -to.x, -to.y, -to.z};
    const double w = to.w - from.w, x = to.x - from.x, y = to.y - from.y, z = to.z - from.z;
    const double angle = 2.0 * std::sqrt(w * w + x * x + y * y + z * z);  // of a small one
    if (angle <= most) return to;
    const double share = most / angle;
    return normalized(Quat{from.w + share * w, from.x + share * x, from.y + share * y, from.z + share * z});
}

/// To the bit: a product of the two rounds, and would leave some turn over for ever. A quaternion and its opposite are
/// one rotation.
bool are_same(Quat a, Quat b) noexcept {
    const auto is = [&](double sign) {
        return a.w == sign * b.w && a.x == sign * b.x && a.y == sign * b.y && a.z == sign * b.z;
    };
    return is(1.0) || is(-1.0);
}

double quantised(double x, double step) { return step > 0.0 ? std::floor(x / step + 0.5) * step : x; }

}  // namespace

SimulatedHand::SimulatedHand(const Plant& plant, const Intent& intent, const Pose& start, double dt)
    : plant_(plant),
      intent_(intent),
      dt_(dt),
      position_(start.position),
      rotation_(start.rotation),
      leg_start_(start.position),
      felt_(static_cast<std::size_t>(std::max(1.0, std::floor(intent.reaction / dt))), start.position),
      planned_(felt_.size(), 0.0) {}

Pose SimulatedHand::reported() const noexcept {
    const double r = plant_.resolution;
    return {{quantised(position_.x, r), quantised(position_.y, r), quantised(position_.z, r)}, rotation_};
}

void SimulatedHand::think() {
    const Vec3 seen = felt_[felt_at_];
    const double planned = planned_[felt_at_];
    felt_[felt_at_] = reported().position;
    planned_[felt_at_] = plan_;
    felt_at_ = (felt_at_ + 1) % felt_.size();
    if (is_done()) return;

    const Leg& leg = intent_.legs[leg_];
    rotation_ = turned_towards(rotation_, leg.target.rotation, turning * dt_);
    const Vec3 way = leg.target.position - leg_start_;
    const double total = length(way);
    const Vec3 along = normalized(way);
    const double seen_at = dot(seen - leg_start_, along);
    const double lag = planned - seen_at;

    if (lag < patience) plan_ = std::min(total, plan_ + leg.speed * dt_);
    if (lag < -surprise) {
        lean_ -= letting_go * lean_ * dt_;
        if (lean_ < let_go) plan_ += letting_go * (std::min(total, seen_at) - plan_) * dt_;
    } else {
        lean_ = std::clamp(lean_ + leaning_rate * lag * dt_, 0.0, leg.push / plant_.arm_stiffness);
    }

    if (are_same(rotation_, leg.target.rotation) && dot(reported().position - leg_start_, along) >= total - arrived) {
        ++leg_;
        leg_start_ = reported().position;
        plan_ = lean_ = 0.0;
        std::fill(planned_.begin(), planned_.end(), 0.0);
        std::fill(felt_.begin(), felt_.end(), leg_start_);
    }
}

Pose SimulatedHand::step(const DeviceCommand& command) {
    think();
    const Setpoint& spring = command.setpoint;
    Vec3 aim = leg_start_;
    if (!is_done()) aim = leg_start_ + (plan_ + lean_) * normalized(intent_.legs[leg_].target.position - leg_start_);
    const double most = is_done() ? HUGE_VAL : intent_.legs[leg_].push;
    const double mass = plant_.arm_mass + plant_.device_mass;
    const double h = dt_ / substeps;
    for (int i = 0; i < substeps; ++i) {
        Vec3 pull = plant_.arm_stiffness * (aim - position_);
        if (const double strength = length(pull); strength > most) pull = (most / strength) * pull;
        Vec3 force_on_hand = linear(command.wrench);
        if (plant_.asks_setpoint) {
            Vec3 f = spring.stiffness * (spring.position - position_) + spring.damping * (spring.velocity - velocity_);
            if (const double strength = length(f); strength > spring.limit) f = (spring.limit / strength) * f;
            force_on_hand = spring.carried + f;
        }
        const Vec3 drag = (plant_.arm_damping + plant_.device_viscosity) * velocity_;
        Vec3 force = pull - drag + force_on_hand;
        // Coulomb friction: it stops the handle, and never turns it back.
        const double speed = length(velocity_), size = length(force);
        if (speed > 1e-6)
            force = force - (plant_.device_friction / speed) * velocity_;
        else if (size <= plant_.device_friction)
            force = -(mass / h) * velocity_;
        else
            force = force - (plant_.device_friction / size) * force;
        velocity_ = velocity_ + (h / mass) * force;
        position_ = position_ + h * velocity_;
    }
    return reported();
}

}  // namespace kerf::simulated_hand
