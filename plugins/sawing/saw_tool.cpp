// SPDX-License-Identifier: Apache-2.0
#include "saw_tool.h"

#include <cmath>

#include "kerf/figure.hpp"

namespace kerf::sawing {

Outline OscillatingBlade::outline() const noexcept {
    using namespace literals;
    constexpr int pieces = 8;  // half of the front: an arc of 60 mm is accurate to 8 µm; fewer pieces make removal
                               // faster
    constexpr double widest = 60.0_deg;
    const SawBlade saw = blade();
    if (std::floor(tooth_count) != tooth_count)
        return refuse("`tooth_count` is ", Figure(tooth_count), "; it needs a whole number.");
    if (!(saw.half_sweep() < widest))
        return refuse("front and swing reach ", Figure(saw.half_sweep() / 1.0_deg, " deg"),
                      " to either side; less than ", Figure(widest / 1.0_deg, " deg"),
                      " is needed: fewer teeth, a smaller `tooth_pitch` or `arc`, or a larger `radius`.");
    Outline outline = prism(saw.kerf(), saw.thickness);
    for (int i = 0; i <= pieces; ++i) {
        const Vec3 front = saw.on_front(sin_cos_exact(saw.half_sweep() * i / pieces));
        outline.to(front.z, front.x);
    }
    const kerf_profile_point end = outline.last();
    const double deepest = 0.9 * radius + end.z;
    if (!(tooth_height < deepest))
        return refuse("`tooth_height` is ", in_mm(tooth_height), "; with this front it needs less than ",
                      in_mm(deepest), ".");
    return outline.to(end.z - tooth_height, end.radius)
        .cuts()
        .to(-radius, end.radius)
        .gripped_at(-radius - 80.0_mm)  // on the handpiece, behind the axis of the swing
        .in_both_hands();
}

}  // namespace kerf::sawing
