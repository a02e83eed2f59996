// SPDX-License-Identifier: Apache-2.0
#include "core/remesh/cut_path.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/field/sweep.h"

namespace kerf {
namespace {

/// Whether one record ends where another begins.
bool follows(const CutRecord& next, const CutRecord& last, const ToolSolid& solid) {
    constexpr double joint = 1e-9;  // [m]
    return next.solid == last.solid && largest_motion(solid, last.to, next.from) <= joint;
}

/// The fraction of the way from `from` to `to` at which a pose lies, by its origin and the end of its solid.
double fraction_at(const ToolSolid& solid, const Pose& from, const Pose& to, const Pose& pose) {
    const Vec3 end{0, 0, solid.end_z()};
    const Vec3 tip_way = to.position - from.position, end_way = to * end - from * end;
    const double size = dot(tip_way, tip_way) + dot(end_way, end_way);
    if (!(size > 0.0)) return 0.0;
    const double t = (dot(pose.position - from.position, tip_way) + dot(pose * end - from * end, end_way)) / size;
    return std::clamp(t, 0.0, 1.0);
}

/// How far from the straight sweep of a solid its turning one may lie [m]: each point goes along an arc, and the hull
/// of both ends bridges it. Of a turn about its own axis a solid of revolution sees nothing.
double bulge(const ToolSolid& solid, const Pose& from, const Pose& to) {
    Quat turn = conjugate(from.rotation) * to.rotation;
    if (!solid.is_prism()) turn.z = 0.0;
    const double half_sine = std::min(1.0, std::sqrt(turn.x * turn.x + turn.y * turn.y + turn.z * turn.z));
    const double reach = std::hypot(solid.largest_radius(), 0.5 * solid.thickness(), solid.tip_z() - solid.end_z());
    return half_sine * reach;
}

/// Whether the poses where records first … last end lie on the straight stretch from the first one's start to the
/// last one's end, one after the other.
bool is_straight(const std::vector<CutRecord>& records, std::size_t first, std::size_t last, const ToolSolid& solid,
                 double tolerance) {
    const Pose &from = records[first].from, &to = records[last].to;
    // Half of the angle times the reach is more than any chord's height over a small turn, and than the overlap of two
    // ends that cross in their middle.
    if (first < last && bulge(solid, from, to) > 2.0 * tolerance) return false;
    double reached = 0.0;
    for (std::size_t i = first; i < last; ++i) {
        const double t = fraction_at(solid, from, to, records[i].to);
        if (largest_motion(solid, between(from, to, t), records[i].to) > tolerance) return false;
        // Back by more than the tolerance: the stretch would miss a turn.
        if (t < reached && largest_motion(solid, between(from, to, t), between(from, to, reached)) > tolerance)
            return false;
        reached = std::max(reached, t);
    }
    return true;
}

/// Points on the surface of a solid, tool frame, at most `apart` from each other.
std::vector<Vec3> surface_points(const ToolSolid& solid, double apart) {
    std::vector<Vec3> points;
    const auto steps_for = [&](double way) { return std::max(1, static_cast<int>(std::ceil(way / apart))); };
    const double half = 0.5 * solid.thickness();
    const auto add_section = [&](double radius, double z, bool is_end) {
        if (solid.is_prism()) {
            // The narrow ends and the flat sides; across the whole front and back too.
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
            add_section(a.radius + t * (b.radius - a.radius), a.z + t * (b.z - a.z), is_first || is_last);
        }
    }
    return points;
}

}  // namespace

std::vector<CutStretch> without_covered(const std::vector<CutStretch>& stretches,
                                        const std::vector<const ToolSolid*>& solids, double tolerance, double apart) {
    std::vector<std::vector<Vec3>> points_of(solids.size());
    std::vector<CutStretch> kept;
    std::vector<Sweep> swept;
    for (const CutStretch& cut : stretches) {
        const ToolSolid& solid = *solids[cut.solid];
        std::vector<Vec3>& points = points_of[cut.solid];
        if (points.empty()) points = surface_points(solid, apart);
        const double way = largest_motion(solid, cut.from, cut.to);
        const int poses = std::max(1, static_cast<int>(std::ceil(way / apart)));
        std::size_t last = 0;  // what covered the last point covers the next one, mostly
        const auto is_covered = [&](Vec3 p) {
            if (last < swept.size() && swept[last].holds(p, -tolerance)) return true;
            for (std::size_t n = swept.size(); n-- > 0;)
                if (swept[n].holds(p, -tolerance)) {
                    last = n;
                    return true;
                }
            return false;
        };
        bool is_new = false;
        for (int n = poses; n >= 0 && !is_new; --n) {
            const Pose pose = between(cut.from, cut.to, static_cast<double>(n) / poses);
            is_new = !std::all_of(points.begin(), points.end(), [&](Vec3 p) { return is_covered(pose * p); });
        }
        if (!is_new) continue;
        kept.push_back(cut);
        swept.emplace_back(solid, cut.from, cut.to, std::max(way, 1e-6), 0.0);
    }
    return kept;
}

std::vector<CutStretch> stretches_of(const std::vector<CutRecord>& records, const std::vector<const ToolSolid*>& solids,
                                     double tolerance) {
    std::vector<CutStretch> stretches;
    for (std::size_t first = 0; first < records.size();) {
        const ToolSolid& solid = *solids[records[first].solid];
        std::size_t chain = first;  // the last record of this path
        while (chain + 1 < records.size() && follows(records[chain + 1], records[chain], solid)) ++chain;
        // Twice as far while that is straight, then between there and the first that is not.
        std::size_t good = first, step = 1;
        while (good < chain && is_straight(records, first, std::min(good + step, chain), solid, tolerance)) {
            good = std::min(good + step, chain);
            step *= 2;
        }
        for (; step > 0; step /= 2)
            if (good + step <= chain && is_straight(records, first, good + step, solid, tolerance)) good += step;
        stretches.push_back({records[first].from, records[good].to, records[first].solid});
        first = good + 1;
    }
    return stretches;
}

}  // namespace kerf
