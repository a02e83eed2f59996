// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dlfcn.h>

#include <memory>
#include <stdexcept>
#include <string>

#include "devices/force_dimension/dhd.h"
#include "devices/force_dimension/force_dimension.h"
#include "tests/devices/driver_rig.h"
#include "tests/devices/force_dimension/double_dhd.h"
#include "tests/run/doubled_device.h"

namespace kerf::force_dimension {

/// A base behind the stand-in for the maker's library.
class ForceDimensionStandIn final : public run::StandIn {
public:
    ForceDimensionStandIn() {
        void* const library = dlopen(folder_and_file().c_str(), RTLD_NOW | RTLD_NODELETE);
        if (library == nullptr) throw std::runtime_error(dlerror());
        set_ = reinterpret_cast<decltype(&double_dhd_set)>(dlsym(library, "double_dhd_set"));
        get_ = reinterpret_cast<decltype(&double_dhd_get)>(dlsym(library, "double_dhd_get"));
        get_(&state_);
    }
    /// Opens the driver. Throws what it throws.
    [[nodiscard]] static std::unique_ptr<DeviceLink> open() {
        return test::open_device(ForceDimension{}, {{"library", KERF_BUILD_DIR "/doubles/dhd_new"}});
    }
    void set_handle(const Pose& device_from_handle, std::uint32_t buttons) override {
        const Vec3 at = to_maker(device_from_handle.position);
        state_.position[0] = at.x, state_.position[1] = at.y, state_.position[2] = at.z;
        put_rotation(device_from_handle.rotation, state_.rotation);
        state_.buttons = static_cast<int>(buttons);
        set_(&state_);
    }
    [[nodiscard]] Vec3 force() override {
        double_dhd_state now{};
        get_(&now);
        return to_device({now.force[0], now.force[1], now.force[2]});
    }

    [[nodiscard]] Pose reported(const Pose& device_from_handle) const override {
        double rows[3][3] = {};
        put_rotation(device_from_handle.rotation, rows);
        return {device_from_handle.position, rotation_of(rows).value()};
    }

private:
    /// Writes a rotation as the maker's matrix: its columns are the images of the maker's axes.
    static void put_rotation(const Quat& device, double (&rows)[3][3]) {
        const Vec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        for (int column = 0; column < 3; ++column) {
            const Vec3 image = to_maker(rotate(device, to_device(axes[column])));
            rows[0][column] = image.x, rows[1][column] = image.y, rows[2][column] = image.z;
        }
    }
    static std::string folder_and_file() { return KERF_BUILD_DIR "/doubles/dhd_new/libdrd.so.3"; }

    decltype(&double_dhd_set) set_ = nullptr;
    decltype(&double_dhd_get) get_ = nullptr;
    double_dhd_state state_{};
};

}  // namespace kerf::force_dimension
