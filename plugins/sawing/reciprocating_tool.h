// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "kerf/outline.hpp"
#include "kerf/plugin.hpp"
#include "kerf/spindle.hpp"
#include "saw_tool.h"
#include "straight_blade.h"

namespace kerf::sawing {

/// The blade of a reciprocating saw with its parameters, SI.
struct ReciprocatingBlade {
    double blade_length, blade_height, stroke, tooth_pitch, blade_thickness, tooth_set, tooth_height;
    double motor_torque, run_up, inertia;
    double stroke_rate;  ///< commanded

    // NOLINTNEXTLINE(readability-function-size): a table, one row for each parameter
    static constexpr auto about() {
        using namespace literals;
        return describe(
            "reciprocating_blade",
            "Blade of a reciprocating saw: teeth in a row along one long edge. It moves to and fro along that edge, "
            "and "
            "the edge is fed into the bone.",
            strategies("kerf.remesh_cgal.local", "kerf.remesh_cgal.exact"),
            param(&ReciprocatingBlade::blade_length,
                  {.id = "blade_length",
                   .help = "Length of the toothed edge, less than a pitch of which is left without a tooth.",
                   .unit = unit::mm,
                   .min = 5.0_mm,
                   .max = 120.0_mm,
                   .def = 50.0_mm,
                   .source = "5 cm [mandibular-angle]"}),
            param(&ReciprocatingBlade::blade_height, {.id = "blade_height",
                                                      .help = "From the back edge to the tips of the teeth.",
                                                      .unit = unit::mm,
                                                      .min = 2.0_mm,
                                                      .max = 40.0_mm,
                                                      .def = 10.0_mm,
                                                      .source = "assumed: order of surgical blades"}),
            param(&ReciprocatingBlade::stroke, {.id = "stroke",
                                                .help = "Travel from one turning point to the other.",
                                                .unit = unit::mm,
                                                .min = 0.5_mm,
                                                .max = 15.0_mm,
                                                .def = 3.0_mm,
                                                .source = "[lannin-2011]"}),
            param(&ReciprocatingBlade::tooth_pitch,
                  {.id = "tooth_pitch",
                   .help = "From tip to tip along the edge. As many teeth as fit on the length.",
                   .unit = unit::mm,
                   .min = 0.3_mm,
                   .max = 5.0_mm,
                   .def = 1.41_mm,
                   .source = "18 teeth an inch [lannin-2011]"}),
            param(&ReciprocatingBlade::blade_thickness, {.id = "blade_thickness",
                                                         .help = "Thickness of the blade behind its teeth.",
                                                         .unit = unit::mm,
                                                         .min = 0.2_mm,
                                                         .max = 3.0_mm,
                                                         .def = 0.8_mm,
                                                         .source = "assumed"}),
            param(&ReciprocatingBlade::tooth_set,
                  {.id = "tooth_set",
                   .help = "How far the teeth protrude from the blade on alternate sides.",
                   .unit = unit::mm,
                   .min = 0.0,
                   .max = 0.5_mm,
                   .def = 0.1_mm,
                   .source = "assumed: as the oscillating blade"}),
            param(&ReciprocatingBlade::tooth_height, {.id = "tooth_height",
                                                      .help = "From the tip of a tooth to its root.",
                                                      .unit = unit::mm,
                                                      .min = 0.2_mm,
                                                      .max = 5.0_mm,
                                                      .def = 1.0_mm,
                                                      .source = "assumed"}),
            param(&ReciprocatingBlade::motor_torque,
                  {.id = "motor_torque",
                   .help = "Maximum torque of the motor, either way, at the crank: one turn an oscillation.",
                   .unit = unit::N_m,
                   .min = 1.0_Nmm,
                   .max = 5000.0_Nmm,
                   .def = 300.0_Nmm,
                   .source = "assumed: order of battery-driven surgical saws"}),
            param(&ReciprocatingBlade::run_up,
                  {.id = "run_up",
                   .help = "Time the unloaded motor takes to 15000 oscillations a minute.",
                   .unit = unit::ms,
                   .min = 0.0,
                   .max = 5000.0_ms,
                   .def = 200.0_ms,
                   .source = "assumed: a controller's soft start; 0 makes the rate follow at once"}),
            param(&ReciprocatingBlade::inertia, {.id = "inertia",
                                                 .help = "Of all moving parts, at the crank.",
                                                 .unit = unit::kg_mm2,
                                                 .min = 1e-8_kg_m2,
                                                 .max = 0.01_kg_m2,
                                                 .def = 2e-6_kg_m2,
                                                 .source = "assumed: order of a small rotor"}),
            drive(&ReciprocatingBlade::stroke_rate, {.id = "stroke_rate",
                                                     .help = "Commanded oscillations; to and fro is one.",
                                                     .unit = unit::per_min,
                                                     .min = 0.0,
                                                     .max = 25000.0_rpm,
                                                     .def = 15000.0_rpm,
                                                     .least = Quantity{slowest_cut, dimension::frequency}}));
    }
    [[nodiscard]] StraightBlade blade() const noexcept {
        constexpr double rounding = 1e-9;  // a length of whole pitches has all its teeth
        return {.length = blade_length,
                .height = blade_height,
                .travel = stroke,
                .pitch = tooth_pitch,
                .tooth_count = static_cast<double>(static_cast<std::size_t>(blade_length / tooth_pitch + rounding)),
                .thickness = blade_thickness,
                .set = tooth_set,
                .tooth_height = tooth_height};
    }
    [[nodiscard]] Motor motor() const noexcept {
        constexpr double full_speed = 15000.0 / 60.0;  // [1/s] that `run_up` is the time to
        return Motor::with_run_up(run_up, full_speed, motor_torque, inertia);
    }
    /// Returns the outline. The teeth's sweep in a stroke removes bone, one tooth height deep. The blade behind it does
    /// not.
    [[nodiscard]] Outline outline() const noexcept;
};

}  // namespace kerf::sawing
