// SPDX-License-Identifier: Apache-2.0
#include "drill_parameters.h"

namespace kerf::drilling {

TwistDrill drill_of(std::span<const double> p) noexcept {
    TwistDrill drill{p[tool_diameter], p[tool_point_angle], p[tool_web], p[tool_length], p[tool_corner]};
    drill.runout = p[tool_runout];
    drill.helix_angle = p[tool_helix_angle];
    if (p.size() == step_drill_parameter_count) {
        const SinCos half = sin_cos_exact(0.5 * p[tool_shoulder_angle]);
        const double begins = p[tool_shoulder_depth], wider = 0.5 * p[tool_shoulder_diameter] - drill.radius();
        drill.corners[0] = {begins, drill.radius()};
        drill.corners[1] = {begins + wider * half.cos / half.sin, drill.radius() + wider};
        drill.corner_count = 2;
    } else if (p.size() == profile_drill_parameter_count) {
        drill.shank_diameter = p[tool_shank_diameter];
        while (drill.corner_count < TwistDrill::most_corners) {
            const std::size_t at = tool_first_depth + 2 * drill.corner_count;
            if (p[at] <= 0.0) break;
            drill.corners[drill.corner_count++] = {p[at], 0.5 * p[at + 1]};
        }
    }
    return drill;
}

Motor motor_of(std::span<const double> p) noexcept {
    using namespace literals;
    if (p[tool_run_up] <= 0.0) return {0.0, p[tool_motor_torque]};
    return {p[tool_inertia], p[tool_motor_torque], 1000.0_rpm / p[tool_run_up]};
}

Coefficients coefficients(std::span<const double> f) noexcept {
    const double depth = f[force_edge_depth];
    return {{f[force_thrust_edge], depth, f[force_thrust_chip]},
            {f[force_cutting_edge], depth, f[force_cutting_chip]},
            {f[force_chisel_edge], depth, f[force_chisel_chip]}};
}

}  // namespace kerf::drilling
