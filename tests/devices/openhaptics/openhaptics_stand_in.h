// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <memory>
#include <stdexcept>
#include <string>

#include "devices/openhaptics/hd.h"
#include "devices/openhaptics/openhaptics.h"
#include "tests/devices/driver_rig.h"
#include "tests/devices/openhaptics/double_hd.h"
#include "tests/run/doubled_device.h"

namespace kerf::openhaptics {

/// A Touch behind the stand-in for libHD.
class OpenHapticsStandIn final : public run::StandIn {
public:
    OpenHapticsStandIn() {
        void* const library = dlopen(KERF_BUILD_DIR "/doubles/hd_new/libHD.so.3.0", RTLD_NOW | RTLD_NODELETE);
        if (library == nullptr) throw std::runtime_error(dlerror());
        set_pose_ = reinterpret_cast<decltype(&double_hd_set_pose)>(dlsym(library, "double_hd_set_pose"));
        force_ = reinterpret_cast<decltype(&double_hd_force)>(dlsym(library, "double_hd_force"));
    }
    /// Opens the driver. Throws what it throws.
    [[nodiscard]] static std::unique_ptr<DeviceLink> open() {
        return test::open_device(OpenHaptics{.wait = 20.0}, {{"library", KERF_BUILD_DIR "/doubles/hd_new"}});
    }
    void set_handle(const Pose& device_from_handle, std::uint32_t buttons) override {
        set_pose_(transform_of(device_from_handle).data(), static_cast<int>(buttons));
    }
    [[nodiscard]] Vec3 force() override {
        double now[3] = {};
        force_(now);
        return {now[0], now[1], now[2]};
    }
    [[nodiscard]] Pose reported(const Pose& device_from_handle) const override {
        const std::array<double, 16> transform = transform_of(device_from_handle);
        double copy[16] = {};
        std::copy(transform.begin(), transform.end(), copy);
        return pose_of(copy).value();
    }

private:
    /// Returns a pose as libHD has it, column by column in mm.
    static std::array<double, 16> transform_of(const Pose& pose) {
        std::array<double, 16> transform{};
        const Vec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        for (std::size_t column = 0; column < 3; ++column) {
            const Vec3 image = rotate(pose.rotation, axes[column]);
            transform[4 * column] = image.x, transform[4 * column + 1] = image.y, transform[4 * column + 2] = image.z;
        }
        transform[12] = 1e3 * pose.position.x, transform[13] = 1e3 * pose.position.y;
        transform[14] = 1e3 * pose.position.z, transform[15] = 1.0;
        return transform;
    }

    decltype(&double_hd_set_pose) set_pose_ = nullptr;
    decltype(&double_hd_force) force_ = nullptr;
};

}  // namespace kerf::openhaptics
