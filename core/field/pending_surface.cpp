// SPDX-License-Identifier: Apache-2.0
#include "core/field/pending_surface.h"

#include <algorithm>
#include <cmath>

namespace kerf {

namespace {

constexpr double rounding = 1e-9;  // [m]

void take(double depth, Vec3 normal, double clamp, kerf_surface_point& answer) noexcept {
    const bool is_near = depth < clamp;
    answer.distance = depth;
    answer.normal = is_near ? normal : Vec3{0, 0, 0};
    answer.body = is_near ? 0 : -1;
}

double larger(double a, double b) noexcept { return a > b ? a : b; }
Vec3 larger(Vec3 a, Vec3 b) noexcept { return {larger(a.x, b.x), larger(a.y, b.y), larger(a.z, b.z)}; }
Vec3 magnitude(Vec3 v) noexcept { return {std::abs(v.x), std::abs(v.y), std::abs(v.z)}; }

}  // namespace

PendingSurface::PendingSurface(const CutTracker& tracker, const Pose& body_from_tool) noexcept
    : tracker_(&tracker), body_from_tool_(body_from_tool), clamp_(tracker.body().grid().clamp()) {
    if (tracker.pending_count() > 0) newest_from_tool_ = tracker.solid_from_tool(tracker.pending_count() - 1, body_from_tool);
}

void PendingSurface::raise(const Vec3* points, std::size_t count, const PointBox& box, double least, const bool* may_rise,
                           kerf_surface_point* answers) const noexcept {
    if (tracker_->pending_count() == 0) return;
    const RevolutionSolid& solid = tracker_->solid();
    const CutTracker::Spread& spread = tracker_->spread();
    const bool is_convex = solid.is_convex();

    // Is any of them as deep in any of the solids as the least distance? Asked of the box as it lies in the newest.
    const Frame& f = newest_from_tool_;
    const double far = 10.0;  // [m] no point beyond is in a solid, and it must not make the others' sums inexact
    const auto kept = [far](const double(&v)[3]) {
        return Vec3{std::clamp(v[0], -far, far), std::clamp(v[1], -far, far), std::clamp(v[2], -far, far)};
    };
    const Vec3 low = kept(box.low), high = kept(box.high);
    const Vec3 middle = f * (0.5 * (low + high)), half = 0.5 * (high - low);
    const double turn = spread.turn * (length(middle) + length(half)) + rounding;
    const Vec3 reach = larger(-spread.low, spread.high);
    const Vec3 extent = half.x * magnitude(f.x) + half.y * magnitude(f.y) + half.z * magnitude(f.z);
    const double deepest = is_convex ? solid.deepest_in(middle, extent + reach)
                                     : length(half) + length(reach) - solid.distance(middle);
    if (deepest + turn <= least) return;  // not so where a number is NaN

    // Each point in the newest. In a convex solid none is deeper than by a plane that touches it: neither there nor where
    // another pose has it.
    PointBlock in_newest, gradient;
    BlockValues depth, at_most;
    transform(f, points, count, in_newest);
    if (is_convex) {
        solid.tangents(in_newest, depth, gradient);
        for (std::size_t p = 0; p < count; ++p)
            at_most[p] = depth[p] + larger(gradient.x[p] * spread.low.x, gradient.x[p] * spread.high.x) +
                         larger(gradient.y[p] * spread.low.y, gradient.y[p] * spread.high.y) +
                         larger(gradient.z[p] * spread.low.z, gradient.z[p] * spread.high.z) + turn;
    } else {
        solid.depths(in_newest, depth);
        for (std::size_t p = 0; p < count; ++p) at_most[p] = depth[p] + length(reach) + turn;
    }
    const std::size_t newest = tracker_->pending_count() - 1;
    std::array<Vec3, block_capacity> concerned;
    std::array<std::uint8_t, block_capacity> lane;
    std::size_t concerned_count = 0;
    for (std::size_t p = 0; p < count; ++p) {
        kerf_surface_point& answer = answers[p];
        if (!(at_most[p] > answer.distance) || answer.distance >= clamp_ || (may_rise != nullptr && !may_rise[p])) continue;
        // Outside, a face may end before it comes so near as its plane.
        const bool is_exact = !is_convex || depth[p] >= 0.0;
        const double in_it = is_exact ? depth[p] : -solid.distance(in_newest[p]);
        if (in_it > answer.distance + rounding)
            take(in_it, turned_back(f, is_convex && is_exact ? gradient[p] : solid.way_in(in_newest[p])), clamp_, answer);
        if (at_most[p] <= answer.distance + 1.5 * rounding) continue;  // `turn` has one in it
        lane[concerned_count] = static_cast<std::uint8_t>(p);
        concerned[concerned_count++] = points[p];
    }

    for (std::size_t i = 0; i < newest && concerned_count > 0; ++i) {
        const Frame solid_from = tracker_->solid_from_tool(i, body_from_tool_);
        PointBlock in_solid;
        transform(solid_from, concerned.data(), concerned_count, in_solid);
        solid.depths(in_solid, depth);
        for (std::size_t p = 0; p < concerned_count; ++p) {
            kerf_surface_point& answer = answers[lane[p]];
            if (depth[p] > answer.distance + rounding)
                take(depth[p], turned_back(solid_from, solid.way_in(in_solid[p])), clamp_, answer);
        }
    }
}

}  // namespace kerf
