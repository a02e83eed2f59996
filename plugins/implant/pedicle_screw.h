// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "threaded_tool.h"

namespace kerf::implant {

/// A pedicle screw with a tapered core, on a driver that a hand turns.
struct PedicleScrew : ThreadedTool {
    static constexpr auto about() {
        using namespace literals;
        return describe("pedicle_screw", "A screw with a tapered core and a seat under its head, on a driver.",
                        common({.outer = {6.5_mm, "weidling-2022: screws of 6 to 7.5 mm"},
                                .taper = {0.0, "cylindrical"},
                                .core = {4.25_mm, "weidling-2022: screw 5"},
                                .tip_core = {3_mm, "assumed: cores taper by about a millimetre"},
                                .pitch = {2.75_mm, "weidling-2022: screw 5"},
                                .length = {45_mm, "assumed: a lumbar screw"},
                                .flank = {15_deg, "assumed: between buttress and V threads"},
                                .flutes = {2.0, "wu-2022: two or three"},
                                .flute_length = {6_mm, "wu-2022: 2.9 to 9.5 mm"}}),
                        head<PedicleScrew>({10_mm, "assumed"}));
    }
};

}  // namespace kerf::implant
