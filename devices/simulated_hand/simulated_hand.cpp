// SPDX-License-Identifier: Apache-2.0
#include "simulated_hand.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace kerf::simulated_hand {

namespace {

constexpr int substeps = 20;                 // of the plant per tick
constexpr double letting_go = 10.0;          // [1/s] decay of the lean when the tip runs ahead [assumed]
constexpr double release_fraction = 0.2e-3;  // [m] lean below which the plan continues from the tip [assumed]
constexpr double patience = 3e-3;            // [m] lag at which the plan waits [assumed]
constexpr double surprise = 0.5e-3;          // [m] lead of the tip over the plan at which the lean decays [assumed]
constexpr double arrived = 0.2e-3;           // [m] distance from a leg's end that counts as reached [assumed]

constexpr double correcting = 1.0;   // [1/s] correction of a tip off the leg [assumed]
constexpr double yielding = 0.5;     // [1/s] with which that correction is forgotten [assumed]
constexpr double max_offset = 3e-3;  // [m] maximum offset of the aim: 2 N on a drill in a hole [assumed]
// [–] Pull, as a fraction of device friction, from which friction is fully compensated [assumed].
constexpr double unfelt = 0.02;
constexpr double correcting_tilt = 0.05;  // [rad/s] of a tool that lies askew in the hand [assumed]
constexpr double almost_turned = 0.01;    // [rad] of the wrist of a hand that has regrasped its tool [assumed]
constexpr double turning = 1.0;           // [rad/s] of the wrist [assumed]
constexpr double turning_back = 2.0;      // [rad/s] of the wrist after it has released the driver [assumed]

constexpr double arm_in_bone = 5e3, leaning_in_bone = 17e3;  // [N/m], [N/(m·s)] [assumed]
constexpr double stiffest_arm = 600.0;                       // [N/m] at the device [assumed]

/// Returns `from`, turned towards `to` by at most `most` [rad].
Quat turned_towards(Quat from, Quat to, double most) {
    if (from.w * to.w + from.x * to.x + from.y * to.y + from.z * to.z < 0.0) to = {-to.w, -to.x, -to.y, -to.z};
    const double w = to.w - from.w, x = to.x - from.x, y = to.y - from.y, z = to.z - from.z;
    const double angle = 2.0 * std::sqrt(w * w + x * x + y * y + z * z);  // for small angles
    if (angle <= most) return to;
    const double share = most / angle;
    return normalized(Quat{from.w + share * w, from.x + share * x, from.y + share * y, from.z + share * z});
}

/// Compares bit for bit: a product of the two rounds, and would leave a small turn for ever. A quaternion and its
/// negative are one rotation.
bool are_same(Quat a, Quat b) noexcept {
    const auto is = [&](double sign) {
        return a.w == sign * b.w && a.x == sign * b.x && a.y == sign * b.y && a.z == sign * b.z;
    };
    return is(1.0) || is(-1.0);
}

/// Returns `spring`, limited to `most`, plus the force that the device's friction takes [N].
Vec3 pulled(Vec3 spring, double most, double friction) noexcept {
    const double strength = length(spring);
    if (strength <= 0.0) return {};
    const double made_up = std::min(friction, strength / unfelt);
    return (std::min(strength, most) + made_up) / strength * spring;
}

/// Returns a rotation without a jump of the quaternion's sign, which has a period of two turns.
Quat turned_about_z(double angle) noexcept {
    constexpr double two_turns = 4.0 * std::numbers::pi;
    return quat_from_rotation_vector({0, 0, std::remainder(angle, two_turns)});
}

double quantised(double x, double step) { return step > 0.0 ? std::floor(x / step + 0.5) * step : x; }

}  // namespace

Plant in_bone(Plant plant, double force_scale) noexcept {
    const double stiffness = std::min(force_scale * arm_in_bone, stiffest_arm);
    plant.arm_damping *= std::max(1.0, std::sqrt(stiffness / plant.arm_stiffness));  // same damping ratio
    plant.arm_stiffness = stiffness;
    plant.leaning = force_scale * leaning_in_bone;
    return plant;
}

double Leg::min_regrip_time() const noexcept {
    return regrip > 0.0 ? std::max(0.0, std::ceil(std::abs(turn) / regrip) - 1.0) * regrip / turning_back : 0.0;
}

SimulatedHand::SimulatedHand(const Plant& plant, const Intent& intent, const Pose& start, double dt)
    : plant_(plant),
      intent_(intent),
      dt_(dt),
      position_(start.position),
      rotation_(start.rotation),
      leg_start_(start.position),
      driver_(start.rotation),
      seen_(static_cast<std::size_t>(std::max(1.0, std::floor(intent.reaction / dt))), start.position),
      planned_(seen_.size(), 0.0),
      felt_torque_(seen_.size(), 0.0),
      felt_event_(seen_.size(), false) {
    begin(0, start.position, start.position);
}

Pose SimulatedHand::reported() const noexcept {
    const double r = plant_.resolution;
    return {{quantised(position_.x, r), quantised(position_.y, r), quantised(position_.z, r)},
            turned_ == 0.0 ? rotation_ : rotation_ * turned_about_z(quantised(turned_, plant_.turn_resolution))};
}

void SimulatedHand::regrasp(const Pose& handle_from_tool) {
    const bool is_turned = turned_ != 0.0 || (!is_done() && intent_.legs[leg_].turn != 0.0);
    grasp_ = is_turned ? Pose{{0, 0, handle_from_tool.position.z}, {1, 0, 0, 0}} : handle_from_tool;
}

bool SimulatedHand::is_turned_to(Quat wrist) const noexcept {
    // A tool that still moves in the hand changes the wrist's end in each tick.
    const Vec3 rest = small_rotation_vector(conjugate(rotation_) * wrist);
    return are_same(rotation_, wrist) || (!are_same(corrected_tilt_, {1, 0, 0, 0}) && length(rest) < almost_turned);
}

Vec3 SimulatedHand::along() const noexcept {
    if (is_done()) return {};
    const Vec3 leg_vector = intent_.legs[leg_].target.position - leg_start_;
    return length(leg_vector) > 0.0 ? normalized(leg_vector) : Vec3{};
}

const std::string& SimulatedHand::awaited_event() const noexcept {
    static const std::string none;
    return is_done() ? none : intent_.legs[leg_].until_event;
}

bool SimulatedHand::turn(const Leg& leg, double felt_torque) {
    if (is_regripping_) {
        const double most = turning_back * dt_;
        if (turned_ == grip_) {  // the wrist is back: it grips, and turns on in the next tick
            is_regripping_ = false;
            turn_end_ = turned_ + driver_end_ - driver_turned_;
        }
        turned_ += std::clamp(grip_ - turned_, -most, most);
        return false;
    }
    double end = turn_end_;
    if (leg.regrip > 0.0) end = std::clamp(end, grip_ - leg.regrip, grip_ + leg.regrip);
    if (turned_ == end) {
        is_regripping_ = end != turn_end_;
        return !is_regripping_;
    }
    if (std::copysign(1.0, leg.turn) * felt_torque > leg.torque) return false;
    const double most = leg.turning * dt_;
    turned_ += std::clamp(end - turned_, -most, most);
    return true;
}

void SimulatedHand::think(const SensedTool& felt) {
    const Vec3 tip = felt.world_from_tool.position;
    const Vec3 seen = seen_[seen_at_] - leg_start_;
    const double planned = planned_[seen_at_], felt_torque = felt_torque_[seen_at_];
    const bool has_felt_event = felt_event_[seen_at_];
    seen_[seen_at_] = tip;
    planned_[seen_at_] = plan_;
    felt_torque_[seen_at_] = felt.torque;
    felt_event_[seen_at_] = felt.has_event;
    seen_at_ = (seen_at_ + 1) % seen_.size();
    driver_turned_ += small_rotation_vector(conjugate(driver_) * felt.world_from_tool.rotation).z;
    driver_ = felt.world_from_tool.rotation;
    if (is_done()) return;

    const Leg& leg = intent_.legs[leg_];
    corrected_tilt_ = turned_towards(corrected_tilt_, grasp_.rotation, correcting_tilt * dt_);
    const Quat wrist_at_end = this->wrist_at_end(leg);
    rotation_ = turned_towards(rotation_, wrist_at_end, turning * dt_);
    const bool is_advancing = turn(leg, felt_torque);
    if (leg.turn != 0.0 && (has_felt_event || std::copysign(1.0, leg.turn) * felt_torque >= leg.until_torque))
        is_turn_over_ = true;
    const double total = length(leg.target.position - leg_start_);
    const Vec3 along = this->along();
    const double seen_at = dot(seen, along), lag = planned - seen_at;

    if (lag < patience && is_advancing) plan_ = std::min(total, plan_ + leg.speed * dt_);
    if (lag < -surprise) {
        lean_ -= letting_go * lean_ * dt_;
        if (lean_ < release_fraction) plan_ += letting_go * (std::min(total, seen_at) - plan_) * dt_;
    } else if (is_advancing) {
        lean_ =
            std::clamp(lean_ + plant_.leaning / plant_.arm_stiffness * lag * dt_, 0.0, leg.push / plant_.arm_stiffness);
    }
    offset_ = offset_ - dt_ * (correcting * (seen - seen_at * along) + yielding * offset_);
    if (const double far = length(offset_); far > max_offset) offset_ = (max_offset / far) * offset_;

    const std::size_t last = intent_.legs.size() - 1;
    if (leg.skip_distance > 0.0 && leg_ < last && length(seen - seen_at * along) > leg.skip_distance)
        begin(last, tip, tip);
    else if (is_turn_over_ && !is_regripping_)
        begin(leg_ + 1, leg_start_ + plan_ * along, tip);
    else if (is_turned_to(wrist_at_end) && turned_ == turn_end_ &&
             (leg.turn != 0.0 || (turns_ ? plan_ >= total : dot(tip - leg_start_, along) >= total - arrived)))
        begin(leg_ + 1, leg.target.position, tip);
}

void SimulatedHand::begin(std::size_t leg, Vec3 from, Vec3 tip) {
    leg_ = leg;
    leg_start_ = from;
    grip_ = turned_;
    is_regripping_ = is_turn_over_ = false;
    if (!is_done()) {
        turn_end_ = turned_ + intent_.legs[leg_].turn;
        driver_end_ = driver_turned_ + intent_.legs[leg_].turn;
    }
    turns_ = !is_done() && !are_same(rotation_, wrist_at_end(intent_.legs[leg_]));
    plan_ = std::max(0.0, dot(tip - leg_start_, along()));
    lean_ = 0.0;
    std::fill(planned_.begin(), planned_.end(), plan_);
    std::fill(seen_.begin(), seen_.end(), tip);
    std::fill(felt_torque_.begin(), felt_torque_.end(), 0.0);
    std::fill(felt_event_.begin(), felt_event_.end(), false);
}

void SimulatedHand::aim_at(const Pose& aim, double max_push) noexcept {
    if (is_finite(aim) && std::isfinite(max_push)) aim_ = {aim, max_push};
}

SimulatedHand::Aim SimulatedHand::aim_of_leg() const noexcept {
    return {{leg_start_ + (plan_ + lean_) * along() + offset_ - rotate(rotation_, grasp_.position), rotation_},
            is_done() ? HUGE_VAL : intent_.legs[leg_].push};
}

Pose SimulatedHand::step(const DeviceCommand& command, const SensedTool& sensed) {
    if (aim_)
        rotation_ = turned_towards(rotation_, aim_->pose.rotation, turning * dt_);
    else if (!sensed.keeps_aim)
        think(sensed);
    const Setpoint& spring = command.setpoint;
    const Aim present = aim_.value_or(aim_of_leg());
    const Vec3 aim = present.pose.position;
    const double most = present.max_push;
    const double mass = plant_.arm_mass + plant_.device_mass;
    const double h = dt_ / substeps;
    for (int i = 0; i < substeps; ++i) {
        const Vec3 pull = pulled(plant_.arm_stiffness * (aim - position_), most, plant_.device_friction);
        Vec3 force_on_hand = linear(command.wrench);
        if (plant_.renders_setpoint) {
            Vec3 f = spring.stiffness * (spring.position - position_) + spring.damping * (spring.velocity - velocity_);
            if (const double strength = length(f); strength > spring.limit) f = (spring.limit / strength) * f;
            force_on_hand = spring.carried + f;
        }
        const Vec3 drag = (plant_.arm_damping + plant_.device_viscosity) * velocity_;
        Vec3 force = pull - drag + force_on_hand;
        // Coulomb friction stops the handle but never reverses it.
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
