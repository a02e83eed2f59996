// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "threaded_tool.h"

namespace kerf::implant {

/// A dental implant with a tapered thread, on its driver.
struct DentalImplant : ThreadedTool {
    static constexpr auto about() {
        using namespace literals;
        return describe("dental_implant", "An implant with a tapered thread and a collar, on a driver.",
                        common({.outer = {4.1_mm, "assumed: a common width"},
                                .taper = {0.6_mm, "assumed"},
                                .core = {3.5_mm, "assumed"},
                                .tip_core = {2.2_mm, "assumed"},
                                .pitch = {0.8_mm, "assumed: 0.6 to 1.25 mm"},
                                .length = {10_mm, "assumed: a common length"},
                                .flank = {20_deg, "assumed"},
                                .flutes = {3.0, "assumed"},
                                .flute_length = {3_mm, "assumed"}}),
                        head<DentalImplant>({4.8_mm, "assumed: collar of an implant at the level of the gum"}));
    }
};

}  // namespace kerf::implant
