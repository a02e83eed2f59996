// SPDX-License-Identifier: Apache-2.0
#include "drill_bit.h"

#include "bit_stiffness.h"
#include "kerf/exact_math.hpp"
#include "kerf/figure.hpp"

namespace kerf::drilling {

using namespace literals;

TwistDrill DrillBit::point() const noexcept {
    TwistDrill drill{diameter, point_angle, web, length, corner};
    drill.runout = runout;
    drill.helix_angle = helix_angle;
    return drill;
}

/// The cones and the land behind the last cone cut. The outline behind them does not.
Outline DrillBit::outline_of(const TwistDrill& drill) const noexcept {
    const double widest = drill.widest_radius(), shank = drill.shank_radius(), e = drill.runout;
    const double land_end = drill.land() - drill.cones().last().end(), head = drill.head(),
                 neck = head + (widest - shank);
    if (!(neck < drill.length))
        return refuse("`length` is ", in_mm(drill.length),
                      "; it needs more than the cutting part and the land behind it, ", in_mm(neck), ".");
    constexpr double softest = 0.1, steepest = 10.0;  // [m/N], [rad/N] upper limits of the host
    const Outline::Bending bending = tip_bending(drill);
    if (const double over = std::max(bending.deflection / softest, bending.slope / steepest); over > 1.0)
        return refuse("`length` is ", in_mm(drill.length), "; a bit of ", in_mm(2.0 * shank),
                      " is too slender for that and needs ", in_mm(0.99 * drill.length / std::cbrt(over)), " or less.");
    Outline outline = revolution({{0.0, e}, {-drill.point_depth(), drill.radius() + e}});
    for (std::size_t i = 0; i < drill.corner_count; ++i) {
        const OutlineCorner& at = drill.corners[i];
        if (-at.depth < outline.last().z && at.depth < land_end) outline.to(-at.depth, at.radius + e);
    }
    outline.to(-land_end, widest + e).cuts();
    if (shank < widest) {
        if (head > land_end) outline.to(-head, widest + e);
        outline.to(-neck, shank + e);
    }
    const double grip_z = -drill.length - 40.0_mm;  // the hand grips the body of the drill behind the chuck
    return outline.to(-drill.length, shank + e)
        .gripped_at(grip_z)
        .bends(bending)
        .weighs({.mass = mass, .centre_z = grip_z, .gyration = 50.0_mm});  // [assumed]
}

TwistDrill StepBit::drill() const noexcept {
    TwistDrill drill = point();
    const SinCos half = sin_cos_exact(0.5 * shoulder_angle);
    const double wider = 0.5 * shoulder_diameter - drill.radius();
    drill.corners[0] = {shoulder_depth, drill.radius()};
    drill.corners[1] = {shoulder_depth + wider * half.cos / half.sin, drill.radius() + wider};
    drill.corner_count = 2;
    return drill;
}

Outline StepBit::outline() const noexcept {
    const TwistDrill drill = this->drill();
    if (!(drill.widest_radius() > drill.radius()))
        return refuse("`shoulder_diameter` is ", in_mm(shoulder_diameter), "; it needs more than `diameter`, ",
                      in_mm(drill.diameter), ".");
    if (shoulder_depth < drill.point_depth())
        return refuse("`shoulder_depth` is ", in_mm(shoulder_depth), "; it needs the depth of the point or more, ",
                      in_mm(drill.point_depth()), ".");
    return outline_of(drill);
}

TwistDrill ProfileBit::drill() const noexcept {
    TwistDrill drill = point();
    drill.shank_diameter = shank_diameter;
    while (drill.corner_count < TwistDrill::max_corners && corner_depth[drill.corner_count] > 0.0) {
        drill.corners[drill.corner_count] = {corner_depth[drill.corner_count],
                                             0.5 * corner_diameter[drill.corner_count]};
        ++drill.corner_count;
    }
    return drill;
}

/// Each corner lies behind the one before it. Between two corners the outline is straight, or it widens by a half angle
/// of one degree or more.
Outline ProfileBit::outline() const noexcept {
    constexpr double slightest = 0.0174550649282176, nearest = 0.01_mm - 1e-9;  // tan 1°; [m], less rounding
    const TwistDrill drill = this->drill();
    OutlineCorner last{drill.point_depth(), drill.radius()};
    for (std::size_t i = 0; i < drill.corner_count; ++i) {
        const double longer = drill.corners[i].depth - last.depth, wider = drill.corners[i].radius - last.radius;
        const char nth[] = {static_cast<char>('1' + i), '\0'};
        if (!(longer >= nearest))
            return refuse("`depth_", nth, "` is ", in_mm(drill.corners[i].depth), "; it needs ", in_mm(nearest),
                          " or more beyond the depth of ", i == 0 ? "the point" : "the corner before", ", ",
                          in_mm(last.depth), ".");
        if (wider != 0.0 && wider < slightest * longer)
            return refuse("`diameter_", nth, "` is ", in_mm(2.0 * drill.corners[i].radius), "; it needs that of ",
                          i == 0 ? "the point" : "the corner before", ", ", in_mm(2.0 * last.radius),
                          ", or a degree of half angle more: ", in_mm(2.0 * (last.radius + slightest * longer)), ".");
        last = drill.corners[i];
    }
    for (std::size_t i = drill.corner_count; i < TwistDrill::max_corners; ++i) {
        const char nth[] = {static_cast<char>('1' + i), '\0'},
                   missing[] = {static_cast<char>('1' + drill.corner_count), '\0'};
        if (corner_depth[i] > 0.0 || corner_diameter[i] > 0.0)
            return refuse("corner ", nth, " is given, but `depth_", missing,
                          "` is 0 mm; corners need numbers from 1 on without a gap, each a depth and a diameter.");
    }
    return outline_of(drill);
}

}  // namespace kerf::drilling
