// SPDX-License-Identifier: Apache-2.0
#include "reciprocating_tool.h"

#include "kerf/figure.hpp"

namespace kerf::sawing {

Outline ReciprocatingBlade::outline() const noexcept {
    using namespace literals;
    const StraightBlade saw = blade();
    if (saw.count() < 1)
        return refuse("no tooth fits: `tooth_pitch` is ", in_mm(tooth_pitch), "; it needs at most `blade_length`, ",
                      in_mm(blade_length), ".");
    if (saw.count() > max_teeth)
        return refuse("`blade_length` ", in_mm(blade_length), " has ", Figure(saw.tooth_count),
                      " teeth of `tooth_pitch` ", in_mm(tooth_pitch), "; at most ",
                      Figure(static_cast<double>(max_teeth)), " are possible.");
    const double deepest = 0.5 * blade_height;
    if (!(tooth_height < deepest))
        return refuse("`tooth_height` is ", in_mm(tooth_height), "; with this `blade_height` it needs less than ",
                      in_mm(deepest), ".");
    return prism(saw.kerf(), saw.thickness)
        .to(0.0, saw.half_sweep())
        .to(-tooth_height, saw.half_sweep())
        .cuts()
        .to(-blade_height, saw.half_sweep())
        .gripped_at(-blade_height - 80.0_mm)  // the grip lies behind the back of the blade
        .in_both_hands();
}

}  // namespace kerf::sawing
