// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "edge_law.h"
#include "kerf/force.hpp"
#include "twist_drill.h"

/// What a twist drill feels: lips and chisel edge that cut, a shank that touches and rubs.
namespace kerf::drilling {

/// Parameters in the order the tables in plugin.cpp declare them.
enum ToolParameter : std::size_t { tool_diameter, tool_point_angle, tool_web, tool_length, tool_corner, tool_parameter_count };
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
    force_relief_angle,
    force_heel_stiffness,
    force_contact_stiffness,
    force_clearance,
    force_friction,
    force_parameter_count
};
enum Drive : std::size_t { drive_spindle_speed, drive_count };
enum Signal : std::size_t { signal_chip_thickness, signal_feed_per_revolution, signal_engagement, signal_drive_power, signal_count };

[[nodiscard]] TwistDrill drill_of(std::span<const double> tool_parameters) noexcept;

/// The law of a twist drill, docs/models/drilling.md.
struct DrillCutting {
    struct State {
        double angle = 0.0;          ///< [rad] of the first lip about the shaft
        double feed_rate = 0.0;      ///< [m/s] of the last tick
        double contact_force = 0.0;  ///< [N] of the last tick
    };
    static constexpr std::size_t tool_parameter_count = drilling::tool_parameter_count;
    static constexpr std::size_t force_parameter_count = drilling::force_parameter_count;
    static constexpr std::size_t drive_count = drilling::drive_count;
    static constexpr std::size_t signal_count = drilling::signal_count;

    static void resist(const Tick& tick, const BoneQuery& bone, const State& state, Channels& channels) noexcept;
    static void commit(const Tick& tick, const BoneQuery& bone, const Advance& advance, State& state,
                       std::span<double> signals, Actions& actions) noexcept;
};
static_assert(ForceLaw<DrillCutting>);

}  // namespace kerf::drilling
