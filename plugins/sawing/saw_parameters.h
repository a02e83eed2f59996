// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "kerf/spindle.hpp"
#include "saw_blade.h"
#include "stroke.h"
#include "tooth_law.h"

/// The plugin's parameters by name.
namespace kerf::sawing {

/// Parameters in the order the tables in plugin.cpp declare them.
enum ToolParameter : std::size_t {
    tool_radius,
    tool_arc,
    tool_tooth_pitch,
    tool_tooth_count,
    tool_blade_thickness,
    tool_tooth_set,
    tool_tooth_height,
    tool_motor_torque,
    tool_run_up,
    tool_inertia,
    tool_parameter_count
};
enum ForceParameter : std::size_t {
    force_thrust_edge,
    force_thrust_chip,
    force_cutting_edge,
    force_cutting_chip,
    force_edge_depth,
    force_set_share,
    force_reference_density,
    force_contact_stiffness,
    force_friction,
    force_parameter_count
};
enum Drive : std::size_t { drive_stroke_rate, drive_count };
inline constexpr double slowest_cut = 5.0;  ///< [1/s] from here on it takes bone
enum Signal : std::size_t {
    signal_chip_thickness,
    signal_engaged_teeth,
    signal_tooth_force,
    signal_vibration,
    signal_binding,
    signal_drive_power,
    signal_stroke_rate,
    signal_count
};
enum Event : std::size_t {
    event_off,
    event_speeding_up,
    event_running,
    event_bogging,
    event_stalled,
    event_running_down,
    event_count
};

[[nodiscard]] SawBlade blade_of(std::span<const double> tool_parameters) noexcept;
[[nodiscard]] Motor motor_of(std::span<const double> tool_parameters) noexcept;

struct Coefficients {
    ToothCoefficients thrust, cutting;
};
[[nodiscard]] Coefficients coefficients(std::span<const double> force_parameters) noexcept;

}  // namespace kerf::sawing
