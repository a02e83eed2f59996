// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/outline.hpp"
#include "kerf/plugin.hpp"
#include "kerf/spindle.hpp"
#include "saw_blade.h"

namespace kerf::sawing {

inline constexpr double slowest_cut = 5.0;  ///< [1/s] from this rate on the blade removes bone

/// The oscillating blade with its parameters, SI.
struct OscillatingBlade {
    double radius, arc, tooth_pitch, tooth_count, blade_thickness, tooth_set, tooth_height;
    double motor_torque, run_up, inertia;
    double stroke_rate;  ///< commanded

    // NOLINTNEXTLINE(readability-function-size): a table, one row for each parameter
    static constexpr auto about() {
        using namespace literals;
        return describe(
            "oscillating_blade", "Blade of an oscillating saw: an arc of teeth that swings about an axis behind it.",
            strategies("kerf.remesh_cgal.local", "kerf.remesh_cgal.exact"),
            param(&OscillatingBlade::radius, {.id = "radius",
                                              .help = "From the axis of the swing to the tips of the teeth.",
                                              .unit = unit::mm,
                                              .min = 20.0_mm,
                                              .max = 90.0_mm,
                                              .def = 60.0_mm,
                                              .source = "assumed: order of sagittal blades"}),
            param(&OscillatingBlade::arc, {.id = "arc",
                                           .help = "Angle of the swing, from one turning point to the other.",
                                           .unit = unit::deg,
                                           .min = 0.5_deg,
                                           .max = 12.0_deg,
                                           .def = 5.0_deg,
                                           .source = "3 to 5 deg [saw-thesis]"}),
            param(&OscillatingBlade::tooth_pitch, {.id = "tooth_pitch",
                                                   .help = "From tip to tip along the arc.",
                                                   .unit = unit::mm,
                                                   .min = 0.3_mm,
                                                   .max = 5.0_mm,
                                                   .def = 1.4_mm,
                                                   .source = "18 teeth an inch [lannin-2011]"}),
            param(&OscillatingBlade::tooth_count, {.id = "tooth_count",
                                                   .help = "Teeth on the arc, a whole number.",
                                                   .min = 1.0,
                                                   .max = 64.0,
                                                   .def = 18.0,
                                                   .source = "assumed: a front 25 mm wide"}),
            param(&OscillatingBlade::blade_thickness, {.id = "blade_thickness",
                                                       .help = "Thickness of the blade behind its teeth.",
                                                       .unit = unit::mm,
                                                       .min = 0.2_mm,
                                                       .max = 3.0_mm,
                                                       .def = 0.8_mm,
                                                       .source = "assumed"}),
            param(&OscillatingBlade::tooth_set,
                  {.id = "tooth_set",
                   .help = "How far the teeth protrude from the blade on alternate sides.",
                   .unit = unit::mm,
                   .min = 0.0,
                   .max = 0.5_mm,
                   .def = 0.1_mm,
                   .source = "assumed: slots 0.05 to 0.2 mm wider than the blade on either side"}),
            param(&OscillatingBlade::tooth_height, {.id = "tooth_height",
                                                    .help = "From the tip of a tooth to its root.",
                                                    .unit = unit::mm,
                                                    .min = 0.2_mm,
                                                    .max = 5.0_mm,
                                                    .def = 1.0_mm,
                                                    .source = "assumed"}),
            param(&OscillatingBlade::motor_torque,
                  {.id = "motor_torque",
                   .help = "Maximum torque of the motor, either way, at its own shaft: one turn an oscillation.",
                   .unit = unit::N_m,
                   .min = 1.0_Nmm,
                   .max = 5000.0_Nmm,
                   .def = 300.0_Nmm,
                   .source = "assumed: order of battery-driven surgical saws"}),
            param(&OscillatingBlade::run_up,
                  {.id = "run_up",
                   .help = "Time the unloaded motor takes to 12000 oscillations a minute.",
                   .unit = unit::ms,
                   .min = 0.0,
                   .max = 5000.0_ms,
                   .def = 200.0_ms,
                   .source = "assumed: a controller's soft start; 0 makes the rate follow at once"}),
            param(&OscillatingBlade::inertia, {.id = "inertia",
                                               .help = "Of all moving parts, at the motor's shaft.",
                                               .unit = unit::kg_mm2,
                                               .min = 1e-8_kg_m2,
                                               .max = 0.01_kg_m2,
                                               .def = 2e-6_kg_m2,
                                               .source = "assumed: order of a small rotor"}),
            drive(&OscillatingBlade::stroke_rate, {.id = "stroke_rate",
                                                   .help = "Commanded oscillations; to and fro is one.",
                                                   .unit = unit::per_min,
                                                   .min = 0.0,
                                                   .max = 25000.0_rpm,
                                                   .def = 12000.0_rpm,
                                                   .least = Quantity{slowest_cut, dimension::frequency}}));
    }
    [[nodiscard]] SawBlade blade() const noexcept {
        return {.radius = radius,
                .arc = arc,
                .pitch = tooth_pitch,
                .tooth_count = tooth_count,
                .thickness = blade_thickness,
                .set = tooth_set,
                .tooth_height = tooth_height};
    }
    [[nodiscard]] Motor motor() const noexcept {
        constexpr double full_speed = 12000.0 / 60.0;  // [1/s] that `run_up` is the time to
        return Motor::with_run_up(run_up, full_speed, motor_torque, inertia);
    }
    /// Returns the outline. The sweep of the swinging teeth removes bone, one tooth height deep. The blade behind it
    /// does not.
    [[nodiscard]] Outline outline() const noexcept;
};

}  // namespace kerf::sawing
