// SPDX-License-Identifier: Apache-2.0
#include "core/field/cut/sweep.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace kerf {

double largest_motion(const ToolSolid& solid, const Pose& from, const Pose& to) noexcept {
    // The distance moved is a convex function of the point. So its maximum is at a corner of a prism's box, or on a rim
    // of the bounding cylinder, here sampled at four azimuths.
    const Frame a = frame_of(from), b = frame_of(to);
    const Vec3 origin = b.origin - a.origin, along_x = solid.largest_radius() * (b.x - a.x), along_z = b.z - a.z;
    const Vec3 along_y = (solid.is_prism() ? 0.5 * solid.thickness() : solid.largest_radius()) * (b.y - a.y);
    const std::array<Vec3, 2> sides =
        solid.is_prism() ? std::array{along_x + along_y, along_x - along_y} : std::array{along_x, along_y};
    double largest = 0.0;
    for (const double z : {solid.tip_z(), solid.end_z()})
        for (const Vec3 side : sides)
            for (const Vec3 moved : {origin + z * along_z + side, origin + z * along_z - side})
                largest = std::max(largest, dot(moved, moved));
    return std::sqrt(largest);
}

namespace {
double longest_slide(const ToolSolid& solid, double depth) noexcept {
    return std::max(0.0, solid.land() - 2.0 * depth);
}
}  // namespace

Travel travel(const ToolSolid& solid, const Pose& from, const Pose& to, double depth) noexcept {
    const double motion = largest_motion(solid, from, to);
    if (!(longest_slide(solid, depth) > 0.0)) return {motion, 0.0, motion};
    const double slide = rotate(conjugate(from.rotation), to.position - from.position).z;
    return {motion, std::abs(slide),
            std::min(motion, 2.0 * largest_motion(solid, from * Pose{{0, 0, slide}, {1, 0, 0, 0}}, to))};
}

Pose between(const Pose& from, const Pose& to, double t) noexcept {
    const double sign = from.rotation.w * to.rotation.w + from.rotation.x * to.rotation.x +
                                    from.rotation.y * to.rotation.y + from.rotation.z * to.rotation.z <
                                0.0
                            ? -1.0
                            : 1.0;
    const auto mix = [&](double a, double b) { return (1.0 - t) * a + t * sign * b; };
    const auto &a = from.rotation, &b = to.rotation;
    return {(1.0 - t) * from.position + t * to.position,
            normalized(Quat{mix(a.w, b.w), mix(a.x, b.x), mix(a.y, b.y), mix(a.z, b.z)})};
}

Sweep::Sweep(const ToolSolid& solid, const Pose& from, const Pose& to, double step, double depth) noexcept
    : solid_(&solid), from_(from), to_(to) {
    const Travel step_length = travel(solid, from, to, depth);
    motion_ = step_length.motion;
    const double slides = step_length.along > 0.0 ? step_length.along / longest_slide(solid, depth) : 0.0;
    count_ = static_cast<int>(
        std::clamp(std::ceil(std::min(motion_ / step, std::max(step_length.aside / step, slides))), 1.0, 4096.0));
}

Sweep::Instant Sweep::at(double t, Vec3 point) const noexcept {
    return {t, -solid_->distance(inverse(between(from_, to_, t)) * point)};
}

bool Sweep::contains(Vec3 point, double tolerance) const noexcept {
    Instant before = at(0.0, point);
    if (before.depth > tolerance) return true;
    for (int i = 1; i <= count_; ++i) {
        const Instant next = at(static_cast<double>(i) / count_, point);
        if (next.depth > tolerance || contains_between(before, next, point, tolerance)) return true;
        before = next;
    }
    return false;
}

void Sweep::may_contain(const PointBlock& points, double tolerance,
                        std::array<bool, block_capacity>& may) const noexcept {
    may.fill(false);
    if (points.count == 0) return;
    constexpr double rounding = 1e-12;  // [m]
    const double minimum = tolerance - rounding, step_length = step();
    Pose last = from_;
    BlockValues before, after;
    PointBlock at_start, at_end, gradient;
    if (solid_->is_convex())
        transform(inverse(from_), points, at_start);
    else
        solid_->depths(inverse(from_), points, before);
    for (int i = 1; i <= count_; ++i) {
        const Pose next = sub_pose(i);
        if (!solid_->is_convex()) {
            solid_->depths(inverse(next), points, after);
            for (std::size_t p = 0; p < points.count; ++p)
                may[p] = may[p] || before[p] > minimum || after[p] > minimum ||
                         0.5 * (before[p] + after[p] + step_length) > minimum;
            before = after;
            continue;
        }
        // Relative to the solid, the path of a point is nearly straight. The tangent plane at its end bounds the depth
        // along it; `bend` allows for its curvature.
        transform(inverse(next), points, at_end);
        solid_->tangents(at_end, after, gradient);
        const Quat turn = conjugate(last.rotation) * next.rotation;
        const double bend = 2.0 * length({turn.x, turn.y, turn.z}) * step_length;
        for (std::size_t p = 0; p < points.count; ++p) {
            const double back = gradient.x[p] * (at_start.x[p] - at_end.x[p]) +
                                gradient.y[p] * (at_start.y[p] - at_end.y[p]) +
                                gradient.z[p] * (at_start.z[p] - at_end.z[p]);
            may[p] = may[p] || after[p] + (back > 0.0 ? back : 0.0) + bend > minimum;
        }
        at_start = at_end;
        last = next;
    }
}

bool Sweep::contains_between(const Instant& a, const Instant& b, Vec3 point, double tolerance) const noexcept {
    const double step_length = slack * motion_ * (b.t - a.t);
    constexpr double finest = 1e-7;  // [m] of motion: the depth may be nearly constant
    if (0.5 * (a.depth + b.depth + step_length) <= tolerance || step_length <= (tolerance < 0.0 ? finest : tolerance))
        return false;
    const Instant middle = at(0.5 * (a.t + b.t), point);
    if (middle.depth > tolerance) return true;
    return a.depth > b.depth
               ? contains_between(a, middle, point, tolerance) || contains_between(middle, b, point, tolerance)
               : contains_between(middle, b, point, tolerance) || contains_between(a, middle, point, tolerance);
}

}  // namespace kerf
