// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "edge_law.h"
#include "kerf/spindle.hpp"
#include "twist_drill.h"

/// The plugin's parameters by name.
namespace kerf::drilling {

/// Parameters in the order the tables in plugin.cpp declare them.
enum ToolParameter : std::size_t {
    tool_diameter,
    tool_point_angle,
    tool_web,
    tool_length,
    tool_corner,
    tool_motor_torque,
    tool_runout,
    tool_helix_angle,
    tool_run_up,
    tool_inertia,
    tool_mass,
    tool_yield_strength,
    tool_parameter_count,
    /* a step drill has three more */ tool_shoulder_diameter = tool_parameter_count,
    tool_shoulder_angle,
    tool_shoulder_depth,
    step_drill_parameter_count,
    /* a profile drill has these */ tool_shank_diameter = tool_parameter_count,
    tool_first_depth,
    tool_first_diameter,
    profile_drill_parameter_count = tool_first_depth + 2 * TwistDrill::most_corners
};
static_assert(profile_drill_parameter_count != step_drill_parameter_count, "their number tells the tools apart");
enum ForceParameter : std::size_t {
    force_thrust_edge,
    force_thrust_chip,
    force_cutting_edge,
    force_cutting_chip,
    force_chisel_edge,
    force_chisel_chip,
    force_edge_depth,
    force_reference_density,
    force_element_pitch,
    force_rake_effect,
    force_relief_angle,
    force_heel_stiffness,
    force_contact_stiffness,
    force_clearance,
    force_friction,
    force_parameter_count
};
enum Drive : std::size_t { drive_spindle_speed, drive_count };
inline constexpr double slowest_cut = 0.5;  ///< [1/s] from here on it takes bone
enum Signal : std::size_t {
    signal_chip_thickness,
    signal_feed_per_revolution,
    signal_engagement,
    signal_drive_power,
    signal_spindle_speed,
    signal_bending_stress,
    signal_count
};
enum Event : std::size_t {
    event_spindle_off,
    event_spinning_up,
    event_running,
    event_bogging,
    event_stalled,
    event_running_down,
    event_reversing,
    event_bit_overbent,
    event_crushing,
    event_wall_broken,
    event_count
};

[[nodiscard]] TwistDrill drill_of(std::span<const double> tool_parameters) noexcept;
[[nodiscard]] Motor motor_of(std::span<const double> tool_parameters) noexcept;

/// Lip and chisel coefficients out of the force parameters.
struct Coefficients {
    EdgeCoefficients thrust, cutting, chisel;
};
[[nodiscard]] Coefficients coefficients(std::span<const double> force_parameters) noexcept;

}  // namespace kerf::drilling
