// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <utility>

#include "devices/hid_force/wheel_link.h"
#include "kerf/device_exchange.hpp"
#include "tests/devices/hid_force/pid_emulator.h"
#include "tests/run/stylus_and_knob.h"

namespace kerf::hid_force {

/// An endless knob with a motor of 1 N·m, behind emulated firmware.
class EmulatedKnob final : public run::KnobStandIn {
public:
    EmulatedKnob() {
        table_->device = std::make_shared<test::PidEmulator>(test::sparse_knob(), &device_time);
        table_->plug_in("/dev/hidraw3");
    }
    /// Opens the driver. Throws what it throws.
    [[nodiscard]] std::unique_ptr<DeviceLink> open() {
        kerf_device_open_in in{};
        in.id = "";
        return open_wheel(std::make_unique<test::PidTransport>(table_),
                          {.full_scale_torque = full_scale,
                           .range = 2.0 * std::numbers::pi,
                           .peak_torque = full_scale,
                           .continuous_torque = 0.5 * full_scale},
                          DeviceRequest(in, nullptr, nullptr));
    }
    void set_turn(double turn) override {
        constexpr std::int64_t counts = 1 << 24;
        const std::int64_t now = std::llround(turn / (2.0 * std::numbers::pi) * static_cast<double>(counts));
        table_->device->turn_to((now % counts + counts) % counts);
    }
    [[nodiscard]] double torque() override {
        const double now = full_scale * table_->device->torque();
        if (std::abs(now) > std::abs(largest_.load())) largest_.store(now);
        return now;
    }
    /// Returns the largest torque that the hand has felt, with its sign [N·m].
    [[nodiscard]] double largest_torque() const noexcept { return largest_.load(); }
    /// Returns what the firmware found wrong with a report; empty if nothing was.
    [[nodiscard]] std::string fault() const { return table_->device->fault(); }

private:
    static constexpr double full_scale = 1.0;  // [N·m]
    std::shared_ptr<test::PidTable> table_ = std::make_shared<test::PidTable>();
    std::atomic<double> largest_{0.0};
};

}  // namespace kerf::hid_force
