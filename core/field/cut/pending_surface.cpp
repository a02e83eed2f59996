// SPDX-License-Identifier: Apache-2.0
#include "core/field/cut/pending_surface.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace kerf {

namespace {

constexpr double rounding = 1e-8;  // [m] upper bound of the rounding error of a distance in single precision
constexpr std::int32_t none = -1;

double larger(double a, double b) noexcept { return a > b ? a : b; }
Vec3 larger(Vec3 a, Vec3 b) noexcept { return {larger(a.x, b.x), larger(a.y, b.y), larger(a.z, b.z)}; }
Vec3 magnitude(Vec3 v) noexcept { return {std::abs(v.x), std::abs(v.y), std::abs(v.z)}; }

}  // namespace

PendingSurface::PendingSurface(const CutTracker& tracker, const Pose& body_from_tool) noexcept
    : tracker_(&tracker), body_from_tool_(body_from_tool), clamp_(tracker.body().grid().clamp()) {
    if (tracker.solid_count() > 0)
        newest_from_tool_ = tracker.solid_from_tool(tracker.solid_count() - 1, body_from_tool);
}

void PendingSurface::raise(const Vec3* points, std::size_t count, const PointBox& box, double minimum,
                           const bool* may_rise, kerf_surface_point* answers) noexcept {
    if (tracker_->solid_count() == 0) return;
    const ToolSolid& solid = tracker_->solid();
    const CutTracker::Spread& spread = tracker_->spread();
    const bool is_convex = solid.is_convex();

    // Return early if no point can be deeper in any solid than `minimum`. Tested with the points' box in the newest
    // solid's frame.
    const Frame& f = newest_from_tool_;
    const double far = 10.0;  // [m] points beyond it lie in no solid, and would make the sums inexact
    const auto kept = [far](const double(&v)[3]) {
        return Vec3{std::clamp(v[0], -far, far), std::clamp(v[1], -far, far), std::clamp(v[2], -far, far)};
    };
    const Vec3 low = kept(box.low), high = kept(box.high);
    const Vec3 middle = f * (0.5 * (low + high)), half = 0.5 * (high - low);
    const double turn = spread.turn * (length(middle) + length(half)) + rounding;
    const Vec3 reach = larger(-spread.low, spread.high);
    const Vec3 extent = half.x * magnitude(f.x) + half.y * magnitude(f.y) + half.z * magnitude(f.z);
    const double deepest =
        is_convex ? solid.deepest_in(middle, extent + reach) : length(half) + length(reach) - solid.distance(middle);
    if (deepest + turn <= minimum) return;  // also continues if a number is NaN

    if (frame_count_ == 0) {
        frames_[frame_count_++] = single(newest_from_tool_);
        for (std::size_t i = 0; i + 1 < tracker_->solid_count(); ++i)
            frames_[frame_count_++] = single(tracker_->solid_from_tool(i, body_from_tool_));
    }
    constexpr float never = 1e30f;
    alignas(32) FloatBlock depth, x, y, z;
    alignas(32) std::array<std::int32_t, block_capacity> which;
    for (std::size_t p = 0; p < count; ++p) {
        const bool may = answers[p].distance < clamp_ && (may_rise == nullptr || may_rise[p]);
        depth[p] = may ? static_cast<float>(answers[p].distance) : never;
        which[p] = none;
    }
    block_kernel().deepest(solid.single(), frames_.data(), frame_count_, count, points,
                           {depth.data(), which.data(), x.data(), y.data(), z.data()});
    for (std::size_t p = 0; p < count; ++p) {
        if (which[p] == none) continue;
        kerf_surface_point& answer = answers[p];
        answer.distance = static_cast<double>(depth[p]);
        const bool is_near = answer.distance < clamp_;
        answer.body = is_near ? 0 : -1;
        answer.normal = {0, 0, 0};
        if (!is_near) continue;
        if (depth[p] >= 0.0f && is_convex) {
            answer.normal = {static_cast<double>(x[p]), static_cast<double>(y[p]), static_cast<double>(z[p])};
        } else {
            const auto n = static_cast<std::size_t>(which[p]);
            const Frame solid_from = tracker_->solid_from_tool(n == 0 ? frame_count_ - 1 : n - 1, body_from_tool_);
            answer.normal = turned_back(solid_from, solid.inward_direction(solid_from * points[p]));
        }
    }
}

}  // namespace kerf
