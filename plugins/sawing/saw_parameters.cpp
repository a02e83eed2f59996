// SPDX-License-Identifier: Apache-2.0
#include "saw_parameters.h"

namespace kerf::sawing {

SawBlade blade_of(std::span<const double> p) noexcept {
    return {.radius = p[tool_radius],
            .arc = p[tool_arc],
            .pitch = p[tool_tooth_pitch],
            .tooth_count = p[tool_tooth_count],
            .thickness = p[tool_blade_thickness],
            .set = p[tool_tooth_set],
            .tooth_height = p[tool_tooth_height]};
}

Motor motor_of(std::span<const double> p) noexcept {
    constexpr double full_speed = 12000.0 / 60.0;  // [1/s] that `run_up` is the time to
    Motor motor{.inertia = p[tool_inertia], .torque = p[tool_motor_torque]};
    if (p[tool_run_up] > 0.0)
        motor.ramp = full_speed / p[tool_run_up];
    else
        motor.inertia = 0.0;
    return motor;
}

Coefficients coefficients(std::span<const double> p) noexcept {
    return {{p[force_thrust_edge], p[force_edge_depth], p[force_thrust_chip]},
            {p[force_cutting_edge], p[force_edge_depth], p[force_cutting_chip]}};
}

}  // namespace kerf::sawing
