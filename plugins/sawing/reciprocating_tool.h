// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "kerf/outline.hpp"
#include "kerf/plugin.hpp"
#include "powered_blade.h"
#include "straight_blade.h"

namespace kerf::sawing {

/// The blade of a reciprocating saw with its parameters, SI.
struct ReciprocatingBlade : PoweredBlade {
    double blade_length, blade_height, stroke, tooth_pitch;

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
            common({.set_source = "assumed: as the oscillating blade",
                    .torque_help = "Maximum torque of the motor, either way, at the crank: one turn an oscillation.",
                    .run_up_help = "Time the unloaded motor takes to 15000 oscillations a minute.",
                    .inertia_help = "Of all moving parts, at the crank.",
                    .stroke_rate = 15000.0_rpm}));
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
        return motor_reaching(full_speed);
    }
    /// Returns the outline. The teeth's sweep in a stroke removes bone, one tooth height deep. The blade behind it does
    /// not.
    [[nodiscard]] Outline outline() const noexcept;
};

}  // namespace kerf::sawing
