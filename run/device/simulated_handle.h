// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/haptics/loop/device_record.h"
#include "devices/simulated_hand/simulated_hand.h"

namespace kerf::run {

/// Returns a simulated arm at the handle of a modelled device.   [any] pure
[[nodiscard]] inline simulated_hand::Plant plant_at(const DeviceRecord& device, double force_scale) noexcept {
    simulated_hand::Plant plant;
    plant.device_mass = device.mass;
    plant.device_viscosity = device.viscosity;
    plant.device_friction = device.friction;
    plant.resolution = device.resolution;
    plant.turn_resolution = device.axis.resolution;
    return simulated_hand::in_bone(plant, force_scale);
}

}  // namespace kerf::run
