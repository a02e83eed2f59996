// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/plugin.hpp"

namespace kerf::implant {

inline constexpr double reference_density = 1850.0;  ///< [kg/m³] that the coefficients below are of: dense bone

/// How bone holds a screw. Strengths grow with the square of the density.
struct ScrewParameters {
    double friction, head_friction, compaction, shear, grip_stiffness, chip, crush, wall_stiffness, seat_stiffness;
    double yield_share, yield_slip, strip_slip, flute_relief;

    static constexpr auto about() {
        using namespace literals;
        return group(
            param(&ScrewParameters::friction, {.id = "friction",
                                               .help = "Of the thread on bone.",
                                               .min = 0.0,
                                               .max = 1.0,
                                               .def = 0.3,
                                               .source = "as the drill's shank: docs/models/drilling.md"}),
            param(&ScrewParameters::head_friction, {.id = "head_friction",
                                                    .help = "Of the head on its seat.",
                                                    .min = 0.0,
                                                    .max = 1.0,
                                                    .def = 0.3,
                                                    .source = "assumed: as the thread's"}),
            param(&ScrewParameters::compaction, {.id = "compaction",
                                                 .help = "Pressure of compacted bone on thread and core.",
                                                 .unit = unit::N_per_mm2,
                                                 .min = 0.0,
                                                 .max = 1000_N_per_mm2,
                                                 .def = 233_N_per_mm2,
                                                 .source = "carter-hayes-1977: 68 MPa at 1 g/cm3"}),
            param(&ScrewParameters::shear, {.id = "shear",
                                            .help = "Shear strength of bone between the crests.",
                                            .unit = unit::N_per_mm2,
                                            .min = 1_N_per_mm2,
                                            .max = 500_N_per_mm2,
                                            .def = 68_N_per_mm2,
                                            .source = "assumed: order of cortical bone along its axis"}),
            param(&ScrewParameters::grip_stiffness,
                  {.id = "grip_stiffness",
                   .help = "Stiffness along the shaft of 1 mm of thread in dense bone.",
                   .unit = unit::N_per_mm,
                   .min = 1_N_per_mm,
                   .max = 1e6_N_per_mm,
                   .def = 1e4_N_per_mm,
                   .source = "assumed: 45 mm in bone of 300 kg/m3 give way by 0.1 mm at 1 kN"}),
            param(&ScrewParameters::chip, {.id = "chip",
                                           .help = "Force per area of groove that a flute cuts.",
                                           .unit = unit::N_per_mm2,
                                           .min = 0.0,
                                           .max = 5000_N_per_mm2,
                                           .def = 200_N_per_mm2,
                                           .source = "assumed: order of cortical bone"}),
            param(&ScrewParameters::crush, {.id = "crush",
                                            .help = "Pressure at which a tip beside its hole goes into bone.",
                                            .unit = unit::N_per_mm2,
                                            .min = 1_N_per_mm2,
                                            .max = 1000_N_per_mm2,
                                            .def = 233_N_per_mm2,
                                            .source = "carter-hayes-1977: 68 MPa at 1 g/cm3"}),
            param(&ScrewParameters::wall_stiffness, {.id = "wall_stiffness",
                                                     .help = "Stiffness of a hole's wall at one place of the core.",
                                                     .unit = unit::N_per_mm,
                                                     .min = 0.0,
                                                     .max = 1e5_N_per_mm,
                                                     .def = 500_N_per_mm,
                                                     .source = "assumed"}),
            param(&ScrewParameters::seat_stiffness, {.id = "seat_stiffness",
                                                     .help = "Stiffness of the bone under the head.",
                                                     .unit = unit::N_per_mm,
                                                     .min = 1_N_per_mm,
                                                     .max = 1e5_N_per_mm,
                                                     .def = 5000_N_per_mm,
                                                     .source = "assumed"}),
            param(&ScrewParameters::yield_share, {.id = "yield_share",
                                                  .help = "Share of its strength at which a thread begins to slip.",
                                                  .min = 0.5,
                                                  .max = 1.0,
                                                  .def = 0.85,
                                                  .source = "ryan-2015: yield at 85.45 % of the largest torque"}),
            param(&ScrewParameters::yield_slip, {.id = "yield_slip",
                                                 .help = "Slip from there to its full strength.",
                                                 .unit = unit::mm,
                                                 .min = 0.01_mm,
                                                 .max = 3_mm,
                                                 .def = 0.5_mm,
                                                 .source = "ryan-2015: 96.5 deg from seat to the largest torque"}),
            param(&ScrewParameters::strip_slip, {.id = "strip_slip",
                                                 .help = "Further slip after which nothing of the thread holds.",
                                                 .unit = unit::mm,
                                                 .min = 0.1_mm,
                                                 .max = 6_mm,
                                                 .def = 1.5_mm,
                                                 .source = "assumed: half a turn"}),
            param(&ScrewParameters::flute_relief, {.id = "flute_relief",
                                                   .help = "Share of the pressure that long flutes take away.",
                                                   .min = 0.0,
                                                   .max = 0.9,
                                                   .def = 0.25,
                                                   .source = "assumed; wu-2022 gives the sign"}));
    }
};

}  // namespace kerf::implant
