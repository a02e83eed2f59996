// SPDX-License-Identifier: Apache-2.0
#include "devices/motion/modelled_handle.h"

#include <string_view>

#include "kerf/device_driver.hpp"

namespace kerf::motion {

kerf_device_facts facts_of_handle(const char* name, std::uint32_t button_count) noexcept {
    kerf_device_facts facts{
        .name = "",
        .abilities = KERF_DEVICE_POSITION | KERF_DEVICE_ROTATION | KERF_DEVICE_FORCE | KERF_DEVICE_MODELLED,
        .button_count = button_count,
        .peak_force = 12.0,
        .continuous_force = 12.0,
        .peak_torque = 0.0,
        .continuous_torque = 0.0,
        .largest_stiffness = 5000.0,
        .largest_damping = 30.0,
        .mass = 0.2,
        .resolution = 10e-6,
        .peak_turn_torque = 0.0,
        .continuous_turn_torque = 0.0,
        .turn_resolution = 0.0};
    detail::copy_text(facts.name, name);
    return facts;
}

kerf_device_state report_of(const Pose& device_from_handle, std::uint32_t buttons, std::uint64_t reports) noexcept {
    return {.reports = reports,
            .age = 0.0,
            .device_from_handle = device_from_handle,
            .buttons = buttons,
            .flags = KERF_DEVICE_VALID,
            .deflection = {},
            .turn = 0.0};
}

}  // namespace kerf::motion
