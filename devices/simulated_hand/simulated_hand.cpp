// SPDX-License-Identifier: Apache-2.0
#include "simulated_hand.h"

#include <algorithm>
#include <cmath>

namespace kerf::simulated_hand {

namespace {

constexpr int substeps = 20;           // of the plant per tick
constexpr double leaning_rate = 4.0;   // [1/s] how quickly the hand leans in on a lag [assumed]
constexpr double arrived = 0.1e-3;     // [m] of the aim at the end of a leg

double quantised(double x, double step) { return step > 0.0 ? std::floor(x / step + 0.5) * step : x; }

}  // namespace

SimulatedHand::SimulatedHand(const Plant& plant, const Intent& intent, const Pose& start, double dt)
    : plant_(plant),
      intent_(intent),
      dt_(dt),
      position_(start.position),
      rotation_(start.rotation),
      aim_(start.position),
      leg_start_(start.position),
      felt_(static_cast<std::size_t>(std::max(1.0, std::floor(intent.reaction / dt))), start.position) {}

Pose SimulatedHand::reported() const noexcept {
    const double r = plant_.resolution;
    return {{quantised(position_.x, r), quantised(position_.y, r), quantised(position_.z, r)}, rotation_};
}

void SimulatedHand::think() {
    const Vec3 seen = felt_[felt_at_];
    felt_[felt_at_] = reported().position;
    felt_at_ = (felt_at_ + 1) % felt_.size();
    if (is_done()) return;

    const Leg& leg = intent_.legs[leg_];
    rotation_ = leg.target.rotation;
    const Vec3 way = leg.target.position - leg_start_;
    const double total = length(way);
    const Vec3 along = normalized(way);

    // The aim runs ahead of what was seen by no more than a reaction time's way and a hand's breadth of lag.
    const double at = dot(aim_ - leg_start_, along), seen_at = dot(seen - leg_start_, along);
    const double ahead = leg.speed * intent_.reaction + 0.5e-3;
    const double next = std::min({at + leg.speed * dt_, std::max(seen_at + ahead, std::min(at, seen_at + ahead)), total});
    const double aim_at = std::max(next, std::min(seen_at, total));
    aim_ = leg_start_ + aim_at * along;

    // Lag makes it lean in, running ahead makes it let go at once.
    const double lag = aim_at - seen_at - leg.speed * intent_.reaction;
    const double most = leg.push / plant_.arm_stiffness;
    double lean = dot(lean_, along);
    if (lag > 0.0)
        lean = std::min(most, lean + leaning_rate * std::min(lag * 20.0, most) * dt_);
    else
        lean = std::max(0.0, lean + leaning_rate * 5.0 * lag * dt_ * 20.0);
    lean_ = lean * along;

    const bool is_there = dot(reported().position - leg_start_, along) >= total - arrived;
    if (is_there || total == 0.0) {
        ++leg_;
        leg_start_ = aim_ = position_;
        lean_ = {};
    }
}

Pose SimulatedHand::step(Vec3 force_on_hand) {
    think();
    const double mass = plant_.arm_mass + plant_.device_mass;
    const double h = dt_ / substeps;
    for (int i = 0; i < substeps; ++i) {
        const Vec3 pull = plant_.arm_stiffness * (aim_ + lean_ - position_);
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
