// SPDX-License-Identifier: Apache-2.0
#include "core/field/cut/cut_log.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/field/cut/reach.h"
#include "kerf/sampled_wall.hpp"

namespace kerf {

namespace {
constexpr double aside_voxels = 0.2;        ///< `Travel::aside` that closes a record, nearly always in one sub-pose
constexpr double along_voxels = 1.0;        ///< `Travel::along` that closes a record
constexpr double test_voxels = 0.05;        ///< motion between two tests whether the open stretch removes bone
constexpr double reversal_voxels = 0.0005;  ///< a smaller turn is rounding
constexpr double bend_voxels = 0.02;        ///< by which a path may be longer than its straight record
constexpr double stray_voxels = 0.04;       ///< the same for the path apart from slides: it strays by < 1/20 voxel
constexpr double wall_voxels = 0.03;        ///< error of the committed wall of an earlier cut
constexpr double end_voxels = 0.25;         ///< the same at a blade's narrow ends, where both sides are near
constexpr double rounding = 1e-9;           ///< [m] bound on the rounding error of a depth

/// Returns the depth [m] in bone that a point of the outline may seem to have although the tool already cut there. The
/// point has the radius `radius` [m]. The wider end of its segment, of radius `widest` [m], cut the wall, and a tool
/// that re-enters its hole slides along that wall. `h`: spacing [m].
double wall_error(const ToolSolid& solid, bool is_at_narrow_end, double radius, double widest, double h) noexcept {
    if (solid.is_prism()) return (is_at_narrow_end ? end_voxels : wall_voxels) * h;
    return wall_voxels * h + std::max(0.0, wall_sagitta(widest, h) - (widest - radius));
}
}  // namespace

void CutTracker::restart(const Pose& body_from_tool) noexcept {
    begin_stretch(body_from_tool);
    is_started_ = true;
    closed_count_ = 0;
}

void CutTracker::begin_stretch(const Pose& body_from_tool) noexcept {
    open_from_ = farthest_ = corner_ = body_from_tool;
    farthest_motion_ = last_tested_motion_ = path_aside_ = 0.0;
    is_open_solid_ = false;
}

void CutTracker::continue_from(const CutTracker& other, std::uint64_t next) noexcept {
    open_from_ = other.open_from_;
    farthest_ = other.farthest_;
    farthest_motion_ = other.farthest_motion_;
    corner_ = other.corner_;
    path_aside_ = other.path_aside_;
    last_removing_ = other.last_removing_;
    has_removed_ = other.has_removed_;
    is_started_ = other.is_started_;
    solid_ = other.solid_;
    solid_number_ = other.solid_number_;
    set_next_sequence(next);
    closed_count_ = 0;
    last_tested_motion_ = 0.0;
    is_open_solid_ = false;
    test_open_stretch();
}

void CutTracker::take_tool(const ToolSolid& solid, std::uint16_t number) noexcept {
    solid_ = &solid;
    solid_number_ = number;
    has_removed_ = is_started_ = is_open_solid_ = false;
}

int CutTracker::advance(const Pose& now, std::uint64_t tick) noexcept {
    if (!is_started_) restart(now);
    closed_count_ = 0;

    const double h = body_->grid().spacing;
    const auto travel_from = [&](const Pose& from) { return travel(*solid_, from, now, PoseStamp::band(h)); };
    Travel stretch_travel = travel_from(open_from_);
    const double further = largest_motion(*solid_, farthest_, now);
    const bool has_turned = stretch_travel.motion < farthest_motion_ || stretch_travel.motion < further;
    // Until the stretch has a corner, its start is the corner.
    double aside = path_aside_ > 0.0 ? travel_from(corner_).aside : stretch_travel.aside;
    const bool has_strayed = path_aside_ + aside > stretch_travel.aside + stray_voxels * h;
    if (further >= reversal_voxels * h &&
        (has_turned || has_strayed || farthest_motion_ + further > stretch_travel.motion + bend_voxels * h)) {
        close_at(farthest_, tick);
        last_reversal_ = sequence_;
        stretch_travel = travel_from(open_from_);
        aside = stretch_travel.aside;
    }
    if (aside >= stray_voxels * h) {
        path_aside_ += aside;
        corner_ = now;
    }
    if (stretch_travel.motion >= farthest_motion_) {
        farthest_ = now;
        farthest_motion_ = stretch_travel.motion;
    }
    if (stretch_travel.aside >= aside_voxels * h || stretch_travel.along >= along_voxels * h)
        close_at(now, tick);
    else
        test_open_stretch();
    return closed_count_;
}

void CutTracker::test_open_stretch() noexcept {
    if (farthest_motion_ < last_tested_motion_ + test_voxels * body_->grid().spacing) return;
    last_tested_motion_ = farthest_motion_;
    if (!is_open_solid_ && !removes_bone(farthest_)) return;
    is_open_solid_ = true;
    set_newest_pose(farthest_);
}

int CutTracker::close(std::uint64_t tick) noexcept {
    closed_count_ = 0;
    if (is_started_ && farthest_motion_ > 0.0) close_at(farthest_, tick);
    return closed_count_;
}

void CutTracker::close_at(const Pose& to, std::uint64_t tick) noexcept {
    CutRecord record;
    record.sequence = sequence_++;
    record.body = body_id_;
    record.solid = solid_number_;
    record.tick = tick;
    record.from = open_from_;
    record.to = to;
    record.removes = is_open_solid_ || removes_bone(to) || removes_bone(between(record.from, to, 0.5));
    begin_stretch(to);
    closed_[static_cast<std::size_t>(closed_count_++)] = record;
    if (!record.removes) return;
    recent_[removing_ever_++ % recent_capacity] = record;

    last_removing_ = to;
    has_removed_ = true;
    if (pending_count_ + 1 == pending_capacity) {  // full: commit early, so that no record is lost
        ++early_commits_;
        commit_oldest();
    }
    pending_[slot(pending_count_++)] = record;
    set_newest_pose(to);
}

void CutTracker::set_newest_pose(const Pose& body_from_tool) noexcept {
    tool_from_body_[slot(solid_count() - 1)] = inverse(body_from_tool);
    spread_ = {};
    for (std::size_t i = 0; i + 1 < solid_count(); ++i) {
        const Pose older_from_newest = tool_from_body(i) * body_from_tool;
        const Vec3 p = older_from_newest.position;
        const Quat& q = older_from_newest.rotation;
        spread_.low = {std::min(spread_.low.x, p.x), std::min(spread_.low.y, p.y), std::min(spread_.low.z, p.z)};
        spread_.high = {std::max(spread_.high.x, p.x), std::max(spread_.high.y, p.y), std::max(spread_.high.z, p.z)};
        spread_.turn = std::max(spread_.turn, 2.0 * length({q.x, q.y, q.z}));  // 2 sin(θ/2)
    }
}

void CutTracker::commit_passed(const Pose& now, bool is_at_front, int maximum) {
    const double h = body_->grid().spacing;
    // A tool drawn back from a record's end has passed that end only if it has also moved sideways by a voxel.
    const auto is_passed = [&](std::size_t i) {
        const Pose& end = pending(i).to;
        if (!is_at_front || largest_motion(*solid_, end, now) < h) return false;
        const double ahead = (inverse(end) * now).position.z;
        return ahead >= 0.0 || largest_motion(*solid_, end * Pose{{0, 0, ahead}, {1, 0, 0, 0}}, now) >= h;
    };
    const auto is_due = [&](std::size_t i) {
        return i < pending_count_ && (pending_count_ - i > pending_limit || is_passed(i));
    };

    // Allow a few bricks for each waiting record, so that stamping keeps up with the tool, and `maximum` beyond
    // `pending_limit`.
    int waiting = progress_.has_begun() ? 1 : 0;
    while (waiting * bricks_per_record < 2 * maximum && is_due(static_cast<std::size_t>(waiting))) ++waiting;
    const int few = std::min(waiting * bricks_per_record, bricks_per_tick);
    const int allowance = is_behind() ? maximum : std::min(std::max(few, waiting * bricks_per_record / 2), maximum);
    last_bricks_ = 0;
    while (pending_count_ > 0 && last_bricks_ < allowance && (progress_.has_begun() || is_due(0))) {
        if (!progress_.has_begun() && !is_passed(0)) ++early_commits_;
        if (!committed_->stamp_part(pending(0), *solid_, allowance, progress_, last_bricks_)) break;
        drop_oldest();
    }
}

void CutTracker::flush() {
    while (pending_count_ > 0) commit_oldest();
}

int CutTracker::commit_oldest() {
    int bricks = 0;
    committed_->stamp_part(pending(0), *solid_, std::numeric_limits<int>::max(), progress_, bricks);
    drop_oldest();
    return bricks;
}

void CutTracker::drop_oldest() noexcept {
    progress_ = {};
    pending_first_ = (pending_first_ + 1) % pending_capacity;
    --pending_count_;
}

std::size_t CutTracker::first_with_gap() const noexcept {
    // Without a turn of the path, the last solid is the farthest along, and the others lie behind it.
    const bool has_turned = pending_count_ > 0 && last_reversal_ > pending(0).sequence;
    return has_turned ? 0 : solid_count() - std::min<std::size_t>(solid_count(), 1);
}

double CutTracker::gap(Vec3 point, Vec3 direction) const noexcept {
    double gap = 0.0;
    for (std::size_t i = first_with_gap(); i < solid_count(); ++i) {
        const Pose& tool_from = tool_from_body(i);
        gap = std::max(gap, solid_->travel_to_leave(tool_from * point, rotate(tool_from.rotation, direction)));
    }
    return gap;
}

double CutTracker::depth_in_pending(Vec3 point) const noexcept {
    double depth = -body_->grid().clamp();
    for (std::size_t i = 0; i < solid_count(); ++i) depth = std::max(depth, depth_in_pending(i, point));
    return depth;
}

void CutTracker::gap(const Pose& body_from_tool, const Vec3* points, std::size_t count, Directions directions,
                     BlockValues& gaps) const noexcept {
    std::fill_n(gaps.begin(), count, 0.0);
    // A point that lies outside a convex solid after moving by the gap found so far has already left it: that solid
    // does not raise the gap.
    PointBlock in_solid, ahead;
    BlockValues depth;
    for (std::size_t i = solid_count(), first = first_with_gap(); i-- > first;) {
        const Frame solid_from = solid_from_tool(i, body_from_tool);
        std::array<Vec3, block_capacity> along;
        for (std::size_t p = 0; p < (directions.is_one() ? 1 : count); ++p)
            along[p] = turned(solid_from, directions[p]);
        const auto direction_of = [&](std::size_t p) -> const Vec3& { return along[directions.is_one() ? 0 : p]; };
        transform(solid_from, points, count, in_solid);
        const bool knows_more = solid_->is_convex() && i + 1 < solid_count();
        if (knows_more) {
            ahead.count = count;
            for (std::size_t p = 0; p < count; ++p) {
                ahead.x[p] = in_solid.x[p] + gaps[p] * direction_of(p).x;
                ahead.y[p] = in_solid.y[p] + gaps[p] * direction_of(p).y;
                ahead.z[p] = in_solid.z[p] + gaps[p] * direction_of(p).z;
            }
        }
        solid_->depths(knows_more ? ahead : in_solid, depth);
        const double inside = knows_more ? -rounding : rounding;
        for (std::size_t p = 0; p < count; ++p)
            if (depth[p] > inside)
                gaps[p] = std::max(gaps[p], solid_->travel_to_leave(in_solid[p], direction_of(p), rounding));
    }
}

bool CutTracker::removes_bone(const Pose& at) const noexcept {
    if (!is_in_reach_of_bone(*body_, *solid_, at, body_->grid().clamp(), CutOnly::yes)) return false;
    if (!has_removed_) return true;

    // Ahead of the last pose that removed bone, along the axis, it removes new bone, however thin the slice.
    if ((inverse(last_removing_) * at).position.z > 1e-9) return true;

    // Elsewhere, test whether the outline lies in present bone by more than the error of its wall.
    const double h = body_->grid().spacing;
    const auto& outline = solid_->outline();
    for (std::size_t azimuth = 0; azimuth < solid_->around(0.0, 0.0).size(); ++azimuth)
        for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
            const double dz = outline[i + 1].z - outline[i].z, dr = outline[i + 1].radius - outline[i].radius,
                         segment_length = std::hypot(dz, dr);
            const double widest = std::max(outline[i].radius, outline[i + 1].radius);
            // No bone is nearer than `distance`, so step by it, but at least by a voxel.
            for (double s = 0.0;;) {
                const double t = segment_length > 0.0 ? s / segment_length : 0.0;
                const double radius = outline[i].radius + t * dr;
                const Vec3 in_tool = solid_->around(radius, outline[i].z + t * dz)[azimuth];
                const Vec3 p = at * in_tool;
                const double limit = -wall_error(*solid_, in_tool.y == 0.0, radius, widest, h);
                double step = h;
                if (body_->region.contains(p)) {
                    const LocatedPoint place = locate(body_->grid(), p);
                    const double distance = std::max(body_->surface.at(place), committed_->at(place));
                    if (distance < limit && depth_in_pending(p) < limit) return true;
                    step = std::max(h, distance);
                }
                if (s >= segment_length) break;
                s = std::min(segment_length, s + step);
            }
        }
    return false;
}

}  // namespace kerf
