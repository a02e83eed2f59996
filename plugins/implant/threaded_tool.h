// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/plugin.hpp"
#include "screw_thread.h"

namespace kerf::implant {

/// Parameters common to all tools with a thread, SI.
struct ThreadedTool {
    double outer_diameter, outer_taper, core_diameter, tip_core_diameter, pitch, starts, thread_length, flank_angle;
    double flutes, flute_length;
    double head_diameter = 0.0;                       ///< of the seat under the head; 0: none
    double shaft_length = 0.0, shaft_diameter = 0.0;  ///< without thread, between thread and head
    bool takes_chips_out = false;                     ///< a tap

    /// A default and its source.
    struct Default {
        Amount value;
        const char* source;
    };
    struct Defaults {
        Default outer, taper, core, tip_core, pitch, length, flank, flutes, flute_length;
    };
    static constexpr auto common(const Defaults& d) {
        using namespace literals;
        return group(strategies("kerf.remesh_cgal.local", "kerf.remesh_cgal.exact"),
                     param(&ThreadedTool::outer_diameter, {.id = "outer_diameter",
                                                           .help = "Diameter over the crests of the thread.",
                                                           .unit = unit::mm,
                                                           .min = 1_mm,
                                                           .max = 10_mm,
                                                           .def = d.outer.value,
                                                           .source = d.outer.source}),
                     param(&ThreadedTool::outer_taper, {.id = "outer_taper",
                                                        .help = "By how much the thread is thinner at the tip.",
                                                        .unit = unit::mm,
                                                        .min = 0.0,
                                                        .max = 5_mm,
                                                        .def = d.taper.value,
                                                        .source = d.taper.source}),
                     param(&ThreadedTool::core_diameter, {.id = "core_diameter",
                                                          .help = "Diameter of the core towards the head.",
                                                          .unit = unit::mm,
                                                          .min = 0.5_mm,
                                                          .max = 9_mm,
                                                          .def = d.core.value,
                                                          .source = d.core.source}),
                     param(&ThreadedTool::tip_core_diameter, {.id = "tip_core_diameter",
                                                              .help = "Diameter of the core at the tip.",
                                                              .unit = unit::mm,
                                                              .min = 0.5_mm,
                                                              .max = 9_mm,
                                                              .def = d.tip_core.value,
                                                              .source = d.tip_core.source}),
                     param(&ThreadedTool::pitch, {.id = "pitch",
                                                  .help = "Distance from crest to crest.",
                                                  .unit = unit::mm,
                                                  .min = 0.2_mm,
                                                  .max = 6_mm,
                                                  .def = d.pitch.value,
                                                  .source = d.pitch.source}),
                     param(&ThreadedTool::starts, {.id = "starts",
                                                   .help = "Threads that run beside each other.",
                                                   .min = 1.0,
                                                   .max = 3.0,
                                                   .def = 1.0,
                                                   .source = "assumed: single lead"}),
                     param(&ThreadedTool::thread_length, {.id = "thread_length",
                                                          .help = "Length of the thread from the tip.",
                                                          .unit = unit::mm,
                                                          .min = 4_mm,
                                                          .max = 90_mm,
                                                          .def = d.length.value,
                                                          .source = d.length.source}),
                     param(&ThreadedTool::flank_angle, {.id = "flank_angle",
                                                        .help = "Angle of a flank to the plane across the shaft.",
                                                        .unit = unit::deg,
                                                        .min = 3_deg,
                                                        .max = 45_deg,
                                                        .def = d.flank.value,
                                                        .source = d.flank.source}),
                     param(&ThreadedTool::flutes, {.id = "flutes",
                                                   .help = "Cutting edges at the tip; 0: none.",
                                                   .min = 0.0,
                                                   .max = 4.0,
                                                   .def = d.flutes.value,
                                                   .source = d.flutes.source}),
                     param(&ThreadedTool::flute_length, {.id = "flute_length",
                                                         .help = "Length of the thread over which they cut.",
                                                         .unit = unit::mm,
                                                         .min = 0.0,
                                                         .max = 90_mm,
                                                         .def = d.flute_length.value,
                                                         .source = d.flute_length.source}));
    }
    template <class Tool>
    static constexpr auto head(Default diameter) {
        using namespace literals;
        return param(&Tool::head_diameter, {.id = "head_diameter",
                                            .help = "Diameter of the seat under the head.",
                                            .unit = unit::mm,
                                            .min = 2_mm,
                                            .max = 16_mm,
                                            .def = diameter.value,
                                            .source = diameter.source});
    }

    /// Returns the distance of the head's seat from the tip [m].
    [[nodiscard]] double seat() const noexcept { return thread_length + shaft_length; }
    [[nodiscard]] ScrewThread thread() const noexcept {
        return {.outer = outer_diameter,
                .outer_at_tip = outer_diameter - outer_taper,
                .core = core_diameter,
                .core_at_tip = tip_core_diameter,
                .pitch = pitch,
                .starts = starts,
                .length = thread_length,
                .flank_angle = flank_angle,
                .flutes = flutes,
                .flute_length = flute_length,
                .head = head_diameter,
                .seat = seat(),
                .takes_chips_out = takes_chips_out};
    }
    /// Returns the outline of an implant with its driver, or of a tap with its handle.
    [[nodiscard]] Outline outline() const noexcept;
};

}  // namespace kerf::implant
