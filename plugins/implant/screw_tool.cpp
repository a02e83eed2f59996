// SPDX-License-Identifier: Apache-2.0
#include "screw_tool.h"

namespace kerf::implant {

using namespace literals;

Outline PedicleScrew::outline() const noexcept {
    const double core = 0.5 * core_diameter, tip = 0.5 * tip_core_diameter, head = 0.5 * head_diameter;
    if (!(core_diameter < outer_diameter))
        return refuse("`core_diameter` is ", in_mm(core_diameter), "; it needs less than `outer_diameter`, ",
                      in_mm(outer_diameter), ".");
    if (tip_core_diameter > core_diameter)
        return refuse("`tip_core_diameter` is ", in_mm(tip_core_diameter), "; it needs `core_diameter` or less, ",
                      in_mm(core_diameter), ".");
    if (!(head_diameter > outer_diameter))
        return refuse("`head_diameter` is ", in_mm(head_diameter), "; it needs more than `outer_diameter`, ",
                      in_mm(outer_diameter), ", or the head could not seat.");
    constexpr double step = 1e-6;  // [m] between the neck and the seat
    if (!(thread_length > thread().cone() + 2.0 * starts * pitch))
        return refuse("`thread_length` is ", in_mm(thread_length),
                      "; it needs more than the cone of the tip and two turns, ",
                      in_mm(thread().cone() + 2.0 * starts * pitch), ".");
    return revolution({{0.0, 0.0}, {-thread().cone(), tip}, {-thread_length, core}})
        .cuts()
        .stays(0.5 * outer_diameter)
        .to(-thread_length - step, head)
        .to(-thread_length - 6.0_mm, head)
        .to(-thread_length - 6.0_mm - step, 4.0_mm)
        .to(-thread_length - 120.0_mm, 4.0_mm)
        .gripped_at(-thread_length - 150.0_mm);
}

}  // namespace kerf::implant
