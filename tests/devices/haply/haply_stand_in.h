// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "devices/haply/haply.h"
#include "tests/devices/driver_rig.h"
#include "tests/devices/haply/mock_service.h"
#include "tests/run/doubled_device.h"

namespace kerf::haply {

/// An Inverse3 behind the stand-in for its service.
class HaplyStandIn final : public run::StandIn {
public:
    /// Opens the driver, with ideal motors. Throws what it throws.
    [[nodiscard]] std::unique_ptr<DeviceLink> open() const {
        return test::open_device(Haply{.port = static_cast<double>(service.port()),
                                       .events_port = static_cast<double>(service.events_port()),
                                       .wait = 20.0,
                                       .peak_force = 4.0,
                                       .continuous_force = 4.0,
                                       .stiffness = 800.0});
    }
    void set_handle(const Pose& device_from_handle, std::uint32_t buttons) override {
        service.set_handle(device_from_handle, buttons);
    }
    [[nodiscard]] Vec3 force() override {
        const Vec3 force = service.force();
        if (length(force) > length(largest_force_)) largest_force_ = force;
        return force;
    }
    /// Returns the largest force that a hand has taken [N].
    [[nodiscard]] Vec3 largest_force() const noexcept { return largest_force_; }

    MockService service;

private:
    Vec3 largest_force_{};
};

}  // namespace kerf::haply
