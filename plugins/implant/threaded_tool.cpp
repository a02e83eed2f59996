// SPDX-License-Identifier: Apache-2.0
#include "threaded_tool.h"

namespace kerf::implant {

using namespace literals;

namespace {

constexpr double step = 1e-6;                                // [m] along the axis, for a step of the outline
constexpr double driver = 4.0_mm;                            // [m] radius [assumed]
constexpr double driver_length = 120.0_mm, hand = 150.0_mm;  // [m] behind the seat

}  // namespace

Outline ThreadedTool::outline() const noexcept {
    const ScrewThread t = thread();
    if (!(core_diameter < outer_diameter))
        return refuse("`core_diameter` is ", in_mm(core_diameter), "; it needs less than `outer_diameter`, ",
                      in_mm(outer_diameter), ".");
    if (tip_core_diameter > core_diameter)
        return refuse("`tip_core_diameter` is ", in_mm(tip_core_diameter), "; it needs `core_diameter` or less, ",
                      in_mm(core_diameter), ".");
    if (!(tip_core_diameter < t.outer_at_tip))
        return refuse("`outer_taper` is ", in_mm(outer_taper),
                      "; it needs less than `outer_diameter` over `tip_core_diameter`, ",
                      in_mm(outer_diameter - tip_core_diameter), ".");
    if (!takes_chips_out && !(head_diameter > outer_diameter))
        return refuse("`head_diameter` is ", in_mm(head_diameter), "; it needs more than `outer_diameter`, ",
                      in_mm(outer_diameter), ", or the head could not seat.");
    if (shaft_diameter > outer_diameter)
        return refuse("`shaft_diameter` is ", in_mm(shaft_diameter), "; it needs `outer_diameter` or less, ",
                      in_mm(outer_diameter), ".");
    if (!(thread_length > t.cone() + 2.0 * t.lead()))
        return refuse("`thread_length` is ", in_mm(thread_length),
                      "; it needs more than the cone of the tip and two turns, ", in_mm(t.cone() + 2.0 * t.lead()),
                      ".");
    Outline outline =
        revolution({{0.0, 0.0}, {-t.cone(), 0.5 * tip_core_diameter}, {-thread_length, 0.5 * core_diameter}});
    outline.threaded({0.5 * outer_diameter, t.lead()});
    if (shaft_length > 2.0 * step)
        outline.to(-thread_length - step, 0.5 * shaft_diameter).to(-seat(), 0.5 * shaft_diameter);
    outline.cuts();
    if (takes_chips_out) return outline.to(-seat() - driver_length, 0.5 * core_diameter).gripped_at(-seat() - hand);
    const double head = 0.5 * head_diameter;
    return outline.to(-seat() - step, head)
        .to(-seat() - 6.0_mm, head)
        .stays()
        .to(-seat() - 6.0_mm - step, driver)
        .to(-seat() - driver_length, driver)
        .gripped_at(-seat() - hand);
}

}  // namespace kerf::implant
