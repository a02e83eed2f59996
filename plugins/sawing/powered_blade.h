// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/cutter_parameters.hpp"

namespace kerf::sawing {

inline constexpr double slowest_cut = 5.0;  ///< [1/s] from this rate on the blade removes bone

/// What both saws have: the section of their blade, and a motor that moves it; all SI.
struct PoweredBlade : MotorParameters {
    double blade_thickness, tooth_set, tooth_height;
    double stroke_rate;  ///< commanded

protected:
    /// What the parameters of a saw say otherwise than those of the other one.
    struct Words {
        const char *set_source, *torque_help, *run_up_help, *inertia_help;
        Quantity stroke_rate;  ///< default
    };
    static constexpr auto common(const Words& words) {
        using namespace literals;
        return group(
            param(&PoweredBlade::blade_thickness, {.id = "blade_thickness",
                                                   .help = "Thickness of the blade behind its teeth.",
                                                   .unit = unit::mm,
                                                   .min = 0.2_mm,
                                                   .max = 3.0_mm,
                                                   .def = 0.8_mm,
                                                   .source = "assumed"}),
            param(&PoweredBlade::tooth_set, {.id = "tooth_set",
                                             .help = "How far the teeth protrude from the blade on alternate sides.",
                                             .unit = unit::mm,
                                             .min = 0.0,
                                             .max = 0.5_mm,
                                             .def = 0.1_mm,
                                             .source = words.set_source}),
            param(&PoweredBlade::tooth_height, {.id = "tooth_height",
                                                .help = "From the tip of a tooth to its root.",
                                                .unit = unit::mm,
                                                .min = 0.2_mm,
                                                .max = 5.0_mm,
                                                .def = 1.0_mm,
                                                .source = "assumed"}),
            torque_parameter({.help = words.torque_help,
                              .min = 1.0_Nmm,
                              .max = 5000.0_Nmm,
                              .def = 300.0_Nmm,
                              .source = "assumed: order of battery-driven surgical saws"}),
            run_up_parameter(words.run_up_help, 200.0_ms,
                             "assumed: a controller's soft start; 0 makes the rate follow at once"),
            inertia_parameter({.help = words.inertia_help,
                               .min = 1e-8_kg_m2,
                               .max = 0.01_kg_m2,
                               .def = 2e-6_kg_m2,
                               .source = "assumed: order of a small rotor"}),
            drive(&PoweredBlade::stroke_rate, {.id = "stroke_rate",
                                               .help = "Commanded oscillations; to and fro is one.",
                                               .unit = unit::per_min,
                                               .min = 0.0,
                                               .max = 25000.0_rpm,
                                               .def = words.stroke_rate,
                                               .least = Quantity{slowest_cut, dimension::frequency}}));
    }
};

}  // namespace kerf::sawing
