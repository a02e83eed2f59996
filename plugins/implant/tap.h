// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "threaded_tool.h"

namespace kerf::implant {

/// A tap: it cuts a thread, removes the chips and is turned back out.
struct Tap : ThreadedTool {
    Tap() noexcept { takes_chips_out = true; }
    static constexpr auto about() {
        using namespace literals;
        return describe("tap", "A tap that cuts the thread for a screw of the same pitch.",
                        common({.outer = {5.5_mm, "kuklo-2003: 1 mm less than the screw"},
                                .taper = {0.0, "cylindrical"},
                                .core = {3.2_mm, "assumed: as the pilot hole"},
                                .tip_core = {3_mm, "assumed"},
                                .pitch = {2.75_mm, "as the pedicle screw's"},
                                .length = {40_mm, "assumed"},
                                .flank = {15_deg, "as the pedicle screw's"},
                                .flutes = {4.0, "assumed"},
                                .flute_length = {40_mm, "assumed: all of it"}}));
    }
};

}  // namespace kerf::implant
