// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "threaded_tool.h"

namespace kerf::implant {

/// A cortical screw; with a shaft, a cancellous screw with a partial thread.
struct BoneScrew : ThreadedTool {
    static constexpr auto about() {
        using namespace literals;
        return describe("bone_screw",
                        "A cortical screw, or a cancellous one with a shaft between thread and head, on a driver.",
                        common({.outer = {4.5_mm, "iso-5835: HA 4.5"},
                                .taper = {0.0, "cylindrical"},
                                .core = {3.0_mm, "iso-5835: HA 4.5"},
                                .tip_core = {2.8_mm, "assumed"},
                                .pitch = {1.75_mm, "iso-5835: HA 4.5"},
                                .length = {36_mm, "assumed"},
                                .flank = {35_deg, "iso-5835: HA, the flank that carries"},
                                .flutes = {2.0, "assumed: self-tapping"},
                                .flute_length = {4_mm, "assumed"}}),
                        head<BoneScrew>({8_mm, "iso-5835: HA 4.5"}),
                        param(&BoneScrew::shaft_length, {.id = "shaft_length",
                                                         .help = "Length without thread between thread and head.",
                                                         .unit = unit::mm,
                                                         .min = 0.0,
                                                         .max = 120_mm,
                                                         .def = 0.0,
                                                         .source = "a cortical screw: thread up to the head"}),
                        param(&BoneScrew::shaft_diameter, {.id = "shaft_diameter",
                                                           .help = "Diameter of that shaft.",
                                                           .unit = unit::mm,
                                                           .min = 0.5_mm,
                                                           .max = 9_mm,
                                                           .def = 3_mm,
                                                           .source = "assumed: as the core"}));
    }
};

}  // namespace kerf::implant
