// SPDX-License-Identifier: Apache-2.0
#include "bone/remesh/swept_before.h"

#include <algorithm>
#include <cmath>

namespace kerf::bone {
namespace {

/// Returns points on the surface of a solid, tool frame, at most `apart` from each other.
std::vector<Vec3> surface_points(const ToolSolid& solid, double apart) {
    std::vector<Vec3> points;
    const auto steps_for = [&](double length_along) {
        return std::max(1, static_cast<int>(std::ceil(length_along / apart)));
    };
    const double half = 0.5 * solid.thickness();
    const auto add_section = [&](double radius, double z, bool is_end) {
        if (solid.is_prism()) {
            // Points on the narrow ends and the flat sides; on the front and back faces also across the thickness.
            const int across = steps_for(2.0 * radius), through = is_end ? steps_for(2.0 * half) : 1;
            for (int i = 0; i <= across; ++i)
                for (int j = 0; j <= through; ++j)
                    points.push_back({radius * (2.0 * i / across - 1.0), half * (2.0 * j / through - 1.0), z});
            return;
        }
        constexpr double turn = 2.0 * 3.14159265358979323846;
        const int around = std::max(8, steps_for(turn * radius)), inwards = is_end ? steps_for(radius) : 0;
        for (int i = 0; i <= inwards; ++i)
            for (int j = 0; j < around; ++j) {
                const double r = inwards == 0 ? radius : radius * i / inwards, angle = turn * j / around;
                points.push_back({r * std::cos(angle), r * std::sin(angle), z});
            }
    };
    const auto& outline = solid.outline();
    for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
        const kerf_profile_point &a = outline[i], &b = outline[i + 1];
        const int steps = steps_for(std::hypot(b.z - a.z, b.radius - a.radius));
        for (int step = i == 0 ? 0 : 1; step <= steps; ++step) {
            const double t = static_cast<double>(step) / steps;
            const bool is_first = i == 0 && step == 0, is_last = i + 2 == outline.size() && step == steps;
            const double z = a.z + t * (b.z - a.z);
            add_section(a.radius + t * (b.radius - a.radius), z, (is_first || is_last) && !solid.is_hollow());
            if (solid.is_hollow()) add_section(solid.bore(), z, false);
        }
    }
    return points;
}

}  // namespace

Box swept_box(const ToolSolid& solid, const CutStretch& stretch) {
    // A polygon with the area of a circle extends beyond it, by 1.3 % of the radius if it has 16 sides.
    const double margin = 0.014 * solid.largest_radius() + 1e-5;
    const ToolSolid::Box from = solid.box(stretch.from), to = solid.box(stretch.to);
    const Vec3 more{margin, margin, margin};
    return {Vec3{std::min(from.low.x, to.low.x), std::min(from.low.y, to.low.y), std::min(from.low.z, to.low.z)} - more,
            Vec3{std::max(from.high.x, to.high.x), std::max(from.high.y, to.high.y), std::max(from.high.z, to.high.z)} +
                more};
}

bool SweptBefore::covers(const CutStretch& cut) const {
    const ToolSolid& solid = *solids_[cut.solid];
    std::vector<Vec3>& points = (*points_of_)[cut.solid];
    if (points.empty()) points = surface_points(solid, apart_);
    const Box box = swept_box(solid, cut);
    std::vector<const Swept*> near;
    for (const auto& one : swept_)
        if (meet(one->box, box)) near.push_back(one.get());
    if (near.empty()) return false;
    const Swept* last = near.back();  // most points are covered by the same sweep as the last one
    const auto is_in = [this](const Swept& one, Vec3 p) {
        return meet(one.box, {p, p}) && one.sweep.contains(p, -tolerance_);
    };
    const auto is_covered = [&](Vec3 p) {
        if (is_in(*last, p)) return true;
        for (std::size_t n = near.size(); n-- > 0;)
            if (is_in(*near[n], p)) {
                last = near[n];
                return true;
            }
        return false;
    };
    const int poses = std::max(1, static_cast<int>(std::ceil(largest_motion(solid, cut.from, cut.to) / apart_)));
    for (int n = poses; n >= 0; --n) {
        const Pose pose = between(cut.from, cut.to, static_cast<double>(n) / poses);
        if (!std::all_of(points.begin(), points.end(), [&](Vec3 p) { return is_covered(pose * p); })) return false;
    }
    return true;
}

void SweptBefore::add(const CutStretch& cut) {
    const ToolSolid& solid = *solids_[cut.solid];
    const double length_along = std::max(largest_motion(solid, cut.from, cut.to), 1e-6);
    Box box = swept_box(solid, cut);
    const Vec3 more{tolerance_, tolerance_, tolerance_};
    box = {box.low - more, box.high + more};
    swept_.push_back(std::make_shared<const Swept>(Swept{Sweep(solid, cut.from, cut.to, length_along, 0.0), box}));
}

}  // namespace kerf::bone
