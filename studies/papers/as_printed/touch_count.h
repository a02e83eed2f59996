// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "printed_drill.h"

/// Touch by counting, as [tsai-2007] prints it, section 4.
namespace kerf::as_printed {

/// So many newtons for each surface point inside bone, against the way the drill moves. As printed: a drill that rests
/// feels nothing, and one that is withdrawn is held back (E00-6); more points are more force (P6).
struct TouchCount {
    double per_point, voxel_width, shank;

    struct Signals {
        double immersed = 0.0;
    };
    static constexpr auto about() {
        using namespace literals;
        return describe("touch_count", "[tsai-2007] section 4, as printed.",
                        param(&TouchCount::per_point, {.id = "per_point",
                                                       .help = "Force of one immersed point.",
                                                       .unit = unit::N,
                                                       .min = 0.0,
                                                       .max = 1000.0_N,
                                                       .def = 0.1_N,
                                                       .source = "[tsai-2007] section 6: one point is 0.1 N"}),
                        as_printed::voxel_width(&TouchCount::voxel_width), as_printed::shank(&TouchCount::shank),
                        signal(&Signals::immersed, {.id = "immersed", .help = "Not kept."}), budget_us(1000));
    }

    using State = LastInterval;

    void resist(const Held<PaperBit>& tool, const BoneQuery& bone, const State& state,
                Channels& channels) const noexcept;
    void commit(const Held<PaperBit>& tool, const BoneQuery& bone, const Advance& advance, State& state,
                Signals& signals, Actions& actions) const noexcept;
};

}  // namespace kerf::as_printed
