// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/outline.hpp"
#include "kerf/plugin.hpp"
#include "powered_blade.h"
#include "saw_blade.h"

namespace kerf::sawing {

/// The oscillating blade with its parameters, SI.
struct OscillatingBlade : PoweredBlade {
    double radius, arc, tooth_pitch, tooth_count;

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
            common(
                {.set_source = "assumed: slots 0.05 to 0.2 mm wider than the blade on either side",
                 .torque_help = "Maximum torque of the motor, either way, at its own shaft: one turn an oscillation.",
                 .run_up_help = "Time the unloaded motor takes to 12000 oscillations a minute.",
                 .inertia_help = "Of all moving parts, at the motor's shaft.",
                 .stroke_rate = 12000.0_rpm}));
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
        return motor_reaching(full_speed);
    }
    /// Returns the outline. The sweep of the swinging teeth removes bone, one tooth height deep. The blade behind it
    /// does not.
    [[nodiscard]] Outline outline() const noexcept;
};

}  // namespace kerf::sawing
