// SPDX-License-Identifier: Apache-2.0
#include "hand_device.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "devices/motion/modelled_handle.h"
#include "devices/motion/motion_file.h"

namespace kerf::simulated_hand {

namespace {

constexpr double tick = 1e-3;      // [s]
constexpr double max_push = 30.0;  // [N] of the arm [assumed]

/// Returns the force that a device makes for a command: at most its peak force, and none for what is no number.
Vec3 rendered(Vec3 force, double peak) noexcept {
    const double largest = std::max({std::abs(force.x), std::abs(force.y), std::abs(force.z)});
    if (!is_finite(force)) return {};
    if (largest <= 0.5 * peak) return force;
    const Vec3 scaled = (1.0 / largest) * force;  // its length cannot overflow
    const double strength = length(scaled);
    return largest * strength > peak ? (peak / strength) * scaled : force;
}

class Link final : public DeviceLink {
public:
    explicit Link(motion::Motion motion)
        : motion_(std::move(motion)),
          facts_(motion::facts_of_handle("simulated arm", motion_.button_count())),
          hand_(plant_of_device(), {}, motion_.at(0).device_from_handle, tick) {}

    [[nodiscard]] kerf_device_facts facts() const override { return facts_; }
    [[nodiscard]] kerf_device_state read() noexcept override {
        return motion::report_of(hand_.reported(), motion_.at(millisecond_).buttons, ++reports_);
    }
    void write(const kerf_device_command& command) noexcept override {
        if ((command.flags & KERF_DEVICE_RUNNING) == 0) return;
        hand_.aim_at(motion_.at(++millisecond_).device_from_handle, max_push);
        const Vec3 force = rendered(command.force, facts_.peak_force);
        static_cast<void>(hand_.step(DeviceCommand{.wrench = make_vec6(force, {}), .setpoint = {}}));
    }

private:
    motion::Motion motion_;
    kerf_device_facts facts_;
    SimulatedHand hand_;
    std::uint64_t millisecond_ = 0, reports_ = 0;
};

}  // namespace

Plant plant_of_device() noexcept {
    const kerf_device_facts facts = motion::facts_of_handle("", 0);
    Plant plant;
    plant.device_mass = facts.mass;
    plant.device_viscosity = 0.2;
    plant.device_friction = 0.0;
    plant.resolution = facts.resolution;
    return plant;
}

std::unique_ptr<DeviceLink> HandDevice::open(const DeviceRequest& request) const {
    motion::require_no_id(request, "simulated_hand");
    return std::make_unique<Link>(motion::motion_of(request).value_or(motion::Motion({motion::MotionRow{}})));
}

}  // namespace kerf::simulated_hand
