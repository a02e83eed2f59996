// SPDX-License-Identifier: Apache-2.0
#include "run/device/aimed_hand.h"

#include <algorithm>

#include "run/device/deflection_response.h"
#include "run/device/simulated_handle.h"

namespace kerf::run {

namespace {

constexpr double hardest_push = 30.0;    // [N] device newtons [assumed]
constexpr double hardest_on_tool = 500;  // [N] of two hands [assumed]
constexpr double relaxing = 10.0;        // [1/s] decay of a lead that exceeds the deflection [assumed]

}  // namespace

Arm arm_at(const DeviceRecord& device, double force_scale) noexcept {
    return {.plant = plant_at(device, force_scale),
            .max_push = std::min({hardest_push, device.peak_force, hardest_on_tool * force_scale})};
}

AimedHand::AimedHand(const documents::DeviceStation& station, const Arm& arm, const Pose& world_from_tool, double dt)
    : world_from_device_(station.world_from_device()),
      speed_(station.speed * station.scale),
      turn_speed_(station.turn_speed * station.scale),
      dead_zone_(station.dead_zone),
      max_push_(arm.max_push),
      max_lead_(arm.max_push / arm.plant.arm_stiffness),
      dt_(dt),
      hand_(arm.plant, {}, world_from_tool, dt),
      aim_(world_from_tool) {}

void AimedHand::move_aim(Vec3 along, Vec3 about) noexcept {
    const Vec3 wanted = response(along, dead_zone_), turn = turn_speed_ * response(about, dead_zone_);
    const Vec3 step = dt_ * speed_ * rotate(world_from_device_, wanted);
    const Vec3 hand = hand_.reported().position;
    const Vec3 before = aim_.position - hand;
    const double decay = 1.0 - relaxing * dt_;
    Vec3 lead = (dot(step, before) > 0.0 ? 1.0 : decay) * before + step;
    const double far = length(lead), max_lead = std::min(1.0, length(wanted)) * max_lead_;
    if (far > max_lead) lead = std::max(max_lead / far, decay) * lead;
    aim_.position = hand + lead;
    if (turn == Vec3{}) return;
    aim_.rotation = normalized(quat_from_rotation_vector(dt_ * rotate(world_from_device_, turn)) * aim_.rotation);
}

Pose AimedHand::step(Vec3 along, Vec3 about, const DeviceCommand& command) {
    move_aim(along, about);
    hand_.aim_at(aim_, max_push_);
    return hand_.step(command);
}

void AimedHand::stop() noexcept {
    hand_.stop();
    aim_ = hand_.reported();
}

}  // namespace kerf::run
