// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/plugin.hpp"
#include "screw_thread.h"

/// The screws that a procedure can set, each on its driver.
namespace kerf::implant {

/// A pedicle screw with a tapered core, on a driver that a hand turns.
struct PedicleScrew {
    double outer_diameter, core_diameter, tip_core_diameter, pitch, starts, thread_length, flank_angle;
    double flutes, flute_length, head_diameter;

    static constexpr auto about() {
        using namespace literals;
        return describe(
            "pedicle_screw", "A screw with a tapered core and a seat under its head, on a driver.",
            param(&PedicleScrew::outer_diameter, {.id = "outer_diameter",
                                                  .help = "Diameter over the crests of the thread.",
                                                  .unit = unit::mm,
                                                  .min = 2_mm,
                                                  .max = 10_mm,
                                                  .def = 6.5_mm,
                                                  .source = "weidling-2022: screws of 6 to 7.5 mm"}),
            param(&PedicleScrew::core_diameter, {.id = "core_diameter",
                                                 .help = "Diameter of the core towards the head.",
                                                 .unit = unit::mm,
                                                 .min = 1_mm,
                                                 .max = 9_mm,
                                                 .def = 4.25_mm,
                                                 .source = "weidling-2022: screw 5"}),
            param(&PedicleScrew::tip_core_diameter, {.id = "tip_core_diameter",
                                                     .help = "Diameter of the core at the tip.",
                                                     .unit = unit::mm,
                                                     .min = 0.5_mm,
                                                     .max = 9_mm,
                                                     .def = 3_mm,
                                                     .source = "assumed: cores taper by about a millimetre"}),
            param(&PedicleScrew::pitch, {.id = "pitch",
                                         .help = "Distance from crest to crest.",
                                         .unit = unit::mm,
                                         .min = 0.5_mm,
                                         .max = 6_mm,
                                         .def = 2.75_mm,
                                         .source = "weidling-2022: screw 5"}),
            param(&PedicleScrew::starts, {.id = "starts",
                                          .help = "Threads that run beside each other.",
                                          .min = 1.0,
                                          .max = 3.0,
                                          .def = 1.0,
                                          .source = "assumed: single lead"}),
            param(&PedicleScrew::thread_length, {.id = "thread_length",
                                                 .help = "Length of the thread from the tip.",
                                                 .unit = unit::mm,
                                                 .min = 5_mm,
                                                 .max = 90_mm,
                                                 .def = 45_mm,
                                                 .source = "assumed: a lumbar screw"}),
            param(&PedicleScrew::flank_angle, {.id = "flank_angle",
                                               .help = "Angle of a flank to the plane across the shaft.",
                                               .unit = unit::deg,
                                               .min = 3_deg,
                                               .max = 45_deg,
                                               .def = 15_deg,
                                               .source = "assumed: between buttress and V threads"}),
            param(&PedicleScrew::flutes, {.id = "flutes",
                                          .help = "Cutting edges at the tip; 0: none.",
                                          .min = 0.0,
                                          .max = 4.0,
                                          .def = 2.0,
                                          .source = "wu-2022: two or three"}),
            param(&PedicleScrew::flute_length, {.id = "flute_length",
                                                .help = "Length of the thread over which they cut.",
                                                .unit = unit::mm,
                                                .min = 0.0,
                                                .max = 20_mm,
                                                .def = 6_mm,
                                                .source = "wu-2022: 2.9 to 9.5 mm"}),
            param(&PedicleScrew::head_diameter, {.id = "head_diameter",
                                                 .help = "Diameter of the seat under the head.",
                                                 .unit = unit::mm,
                                                 .min = 3_mm,
                                                 .max = 16_mm,
                                                 .def = 10_mm,
                                                 .source = "assumed"}));
    }
    [[nodiscard]] ScrewThread thread() const noexcept {
        return {outer_diameter, core_diameter, tip_core_diameter, pitch,        starts, thread_length,
                flank_angle,    flutes,        flute_length,      head_diameter};
    }
    [[nodiscard]] Outline outline() const noexcept;
};

}  // namespace kerf::implant
