// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/loop/device_record.h"

#include <cstring>

#include "kerf/units.hpp"

namespace kerf {

namespace {
using namespace literals;

constexpr double unknown_force_ratio = 0.25;  // continuous force without a datasheet: a quarter of peak [assumed]

// Limits: [chai3d]. Masses, friction and resolution are not from a datasheet; check them on a device.
constexpr DeviceRecord devices[] = {
    {"touch",
     3.3,
     0.88,
     0.0,
     400.0,
     4.0,
     0.045,
     0.1,
     0.26,
     55e-6,
     {2860.0, 1370.0, 991.0},
     "[chai3d]; continuous force from the maker"},
    {"desktop",
     7.9,
     unknown_force_ratio * 7.9,
     0.0,
     1000.0,
     5.0,
     0.045,
     0.1,
     0.06,
     23e-6,
     {1160.0, 539.0, 381.0},
     "[chai3d]"},
    {"premium-1.5-6dof",
     8.5,
     unknown_force_ratio * 8.5,
     0.188,
     800.0,
     5.0,
     0.075,
     0.1,
     0.04,
     30e-6,
     {1060.0, 490.0, 345.0},
     "[chai3d]"},
    {"omega.6",
     12.0,
     unknown_force_ratio * 12.0,
     0.0,
     5000.0,
     30.0,
     0.2,
     0.2,
     0.1,
     10e-6,
     {2630.0, 1230.0, 865.0},
     "[chai3d]; rest assumed"},
    {"touch-driver",
     3.3,
     0.88,
     0.0,
     400.0,
     4.0,
     0.045,
     0.1,
     0.26,
     55e-6,
     {2860.0, 1370.0, 991.0},
     "touch; motor about the stylus [assumed]",
     {.peak_torque = 0.35, .resolution = 0.09_deg, .friction = 0.01}},
};
}  // namespace

std::span<const DeviceRecord> all_devices() noexcept { return devices; }

std::vector<std::string> device_ids() {
    std::vector<std::string> ids;
    for (const DeviceRecord& device : devices) ids.emplace_back(device.id);
    return ids;
}

const DeviceRecord* find_device(const char* id) noexcept {
    for (const auto& device : devices)
        if (std::strcmp(device.id, id) == 0) return &device;
    return nullptr;
}

}  // namespace kerf
