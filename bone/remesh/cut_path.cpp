// SPDX-License-Identifier: Apache-2.0
#include "bone/remesh/cut_path.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/field/cut/sweep.h"

namespace kerf::bone {
namespace {

/// Returns whether one record begins where another ends.
bool follows(const CutRecord& next, const CutRecord& last, const ToolSolid& solid) {
    constexpr double joint = 1e-9;  // [m]
    return next.solid == last.solid && largest_motion(solid, last.to, next.from) <= joint;
}

/// Returns the fraction of the path from `from` to `to` at which a pose lies, by its origin and the end of its solid.
double fraction_at(const ToolSolid& solid, const Pose& from, const Pose& to, const Pose& pose) {
    const Vec3 end{0, 0, solid.end_z()};
    const Vec3 tip_travel = to.position - from.position, end_travel = to * end - from * end;
    const double size = dot(tip_travel, tip_travel) + dot(end_travel, end_travel);
    if (!(size > 0.0)) return 0.0;
    const double t = (dot(pose.position - from.position, tip_travel) + dot(pose * end - from * end, end_travel)) / size;
    return std::clamp(t, 0.0, 1.0);
}

/// Returns how far the straight sweep of a solid is from its turning one [m]: each point moves on an arc, and the hull
/// of both ends replaces it by a chord. A turn about its own axis does not move a solid of revolution.
double bulge(const ToolSolid& solid, const Pose& from, const Pose& to) {
    Quat turn = conjugate(from.rotation) * to.rotation;
    if (!solid.is_prism()) turn.z = 0.0;
    const double half_sine = std::min(1.0, std::sqrt(turn.x * turn.x + turn.y * turn.y + turn.z * turn.z));
    const double reach = std::hypot(solid.largest_radius(), 0.5 * solid.thickness(), solid.tip_z() - solid.end_z());
    return half_sine * reach;
}

/// Returns whether the end poses of records first … last lie in order on the straight stretch from the first one's
/// start to the last one's end.
bool is_straight(const std::vector<CutRecord>& records, std::size_t first, std::size_t last, const ToolSolid& solid,
                 double tolerance) {
    const Pose &from = records[first].from, &to = records[last].to;
    // Half of the angle times the reach exceeds the height of any chord over a small turn. It also exceeds the overlap
    // of two ends that cross in the middle.
    if (first < last && bulge(solid, from, to) > 2.0 * tolerance) return false;
    double reached = 0.0;
    for (std::size_t i = first; i < last; ++i) {
        const double t = fraction_at(solid, from, to, records[i].to);
        if (largest_motion(solid, between(from, to, t), records[i].to) > tolerance) return false;
        // A path back by more than the tolerance would lose its turning point.
        if (t < reached && largest_motion(solid, between(from, to, t), between(from, to, reached)) > tolerance)
            return false;
        reached = std::max(reached, t);
    }
    return true;
}

}  // namespace

std::optional<CutStretch> StretchJoiner::push(const CutRecord& record) {
    const ToolSolid& solid = *solids_[record.solid];
    if (open_.empty()) {
        open_.push_back(record);
        return std::nullopt;
    }
    const bool continues = follows(record, open_.back(), *solids_[open_.back().solid]);
    open_.push_back(record);
    if (continues && largest_motion(solid, open_.front().from, record.to) <= longest_ &&
        is_straight(open_, 0, open_.size() - 1, solid, tolerance_))
        return std::nullopt;
    open_.pop_back();
    const auto ended = end();
    open_.push_back(record);
    return ended;
}

std::optional<CutStretch> StretchJoiner::open() const {
    if (open_.empty()) return std::nullopt;
    return CutStretch{open_.front().from, open_.back().to, open_.front().solid};
}

std::optional<CutStretch> StretchJoiner::end() {
    const auto ended = open();
    open_.clear();
    return ended;
}

std::vector<CutStretch> stretches_of(const std::vector<CutRecord>& records, const std::vector<const ToolSolid*>& solids,
                                     double tolerance) {
    std::vector<CutStretch> stretches;
    for (std::size_t first = 0; first < records.size();) {
        const ToolSolid& solid = *solids[records[first].solid];
        std::size_t chain = first;  // the last record of this path
        while (chain + 1 < records.size() && follows(records[chain + 1], records[chain], solid)) ++chain;
        // Doubles the step while the path is straight, then bisects to the last straight record.
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

}  // namespace kerf::bone
