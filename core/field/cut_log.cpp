// SPDX-License-Identifier: Apache-2.0
#include "core/field/cut_log.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/field/azimuths.h"
#include "core/field/reach.h"

namespace kerf {

namespace {
constexpr double record_voxels = 0.05;      ///< motion that closes a record (R2)
constexpr double reversal_voxels = 0.0005;  ///< turning back by less is rounding, not a reversal
constexpr double wall_voxels = 0.03;        ///< how exact the committed wall of an earlier cut is
constexpr double rounding = 1e-9;           ///< [m] of distances that are compared with bounds
}  // namespace

void CutTracker::restart(const Pose& body_from_tool) noexcept {
    open_from_ = farthest_ = body_from_tool;
    farthest_motion_ = 0.0;
    is_started_ = true;
    closed_count_ = 0;
}

int CutTracker::advance(const Pose& now, std::uint64_t tick) noexcept {
    if (!is_started_) restart(now);
    closed_count_ = 0;

    const double h = body_->grid().spacing;
    double motion = largest_motion(*solid_, open_from_, now);
    if (motion < farthest_motion_ && largest_motion(*solid_, farthest_, now) >= reversal_voxels * h) {
        close_at(farthest_, tick);
        last_reversal_ = sequence_;
        motion = largest_motion(*solid_, open_from_, now);
    }
    if (motion >= farthest_motion_) {
        farthest_ = now;
        farthest_motion_ = motion;
    }
    if (motion >= record_voxels * h) close_at(now, tick);
    return closed_count_;
}

int CutTracker::close(std::uint64_t tick) noexcept {
    closed_count_ = 0;
    if (is_started_ && farthest_motion_ > 0.0) close_at(farthest_, tick);
    return closed_count_;
}

void CutTracker::close_at(const Pose& to, std::uint64_t tick) noexcept {
    CutRecord record;
    record.sequence = sequence_++;
    record.tick = tick;
    record.from = open_from_;
    record.to = to;
    record.removes = removes_bone(to) || removes_bone(between(record.from, to, 0.5));
    open_from_ = farthest_ = to;
    farthest_motion_ = 0.0;
    closed_[static_cast<std::size_t>(closed_count_++)] = record;
    if (!record.removes) return;

    last_removing_ = to;
    has_removed_ = true;
    if (pending_count_ == pending_capacity) {  // nobody has come to commit: rather early than lost
        ++early_commits_;
        commit_oldest();
    }
    const std::size_t slot = (pending_first_ + pending_count_) % pending_capacity;
    pending_[slot] = record;
    pending_inverse_[slot] = inverse(record.to);
    ++pending_count_;
    compare_with_newest();
}

void CutTracker::compare_with_newest() noexcept {
    farthest_pending_ = largest_turn_ = 0.0;
    for (std::size_t i = 0; i + 1 < pending_count_; ++i) {
        const Pose newest_from_older = tool_from_body(pending_count_ - 1) * pending(i).to;
        const Quat& q = newest_from_older.rotation;
        farthest_pending_ = std::max(farthest_pending_, length(newest_from_older.position));
        largest_turn_ = std::max(largest_turn_, 2.0 * length({q.x, q.y, q.z}));
    }
}

void CutTracker::commit_passed(const Pose& now, bool is_at_front) {
    const double h = body_->grid().spacing;
    const auto is_passed = [&](std::size_t i) {
        return i < pending_count_ && is_at_front && largest_motion(*solid_, pending(i).to, now) >= h;
    };
    last_bricks_ = 0;
    while (pending_count_ > pending_limit) {
        if (!is_passed(0)) ++early_commits_;
        last_bricks_ += commit_oldest();
    }

    // A few bricks a tick for each record that waits, so that the tool does not leave the stamping behind.
    int allowance = 0;
    while (is_passed(static_cast<std::size_t>(allowance / bricks_per_tick))) allowance += bricks_per_tick;
    if (allowance == 0 && progress_.has_begun()) allowance = bricks_per_tick;
    while (pending_count_ > 0 && last_bricks_ < allowance && (progress_.has_begun() || is_passed(0))) {
        if (!committed_->stamp_on(pending(0), *solid_, allowance, progress_, last_bricks_)) break;
        drop_oldest();
    }
}

void CutTracker::flush() {
    while (pending_count_ > 0) commit_oldest();
}

int CutTracker::commit_oldest() {
    int bricks = 0;
    committed_->stamp_on(pending(0), *solid_, std::numeric_limits<int>::max(), progress_, bricks);
    drop_oldest();
    return bricks;
}

void CutTracker::drop_oldest() noexcept {
    progress_ = {};
    pending_first_ = (pending_first_ + 1) % pending_capacity;
    --pending_count_;
}

std::size_t CutTracker::first_that_matters() const noexcept {
    // Without a turn the last pending solid is the farthest along; the others lie behind it.
    const bool has_turned = pending_count_ > 0 && last_reversal_ > pending(0).sequence;
    return has_turned ? 0 : pending_count_ - std::min<std::size_t>(pending_count_, 1);
}

double CutTracker::gap(Vec3 point, Vec3 direction) const noexcept {
    double gap = 0.0;
    for (std::size_t i = first_that_matters(); i < pending_count_; ++i) {
        const Pose& tool_from = tool_from_body(i);
        gap = std::max(gap, solid_->travel_to_leave(tool_from * point, rotate(tool_from.rotation, direction)));
    }
    return gap;
}

double CutTracker::depth_in_pending(Vec3 point) const noexcept {
    double depth = -body_->grid().clamp();
    for (std::size_t i = 0; i < pending_count_; ++i) depth = std::max(depth, depth_in_pending(i, point));
    return depth;
}

void CutTracker::gap(const PointBlock& points, Vec3 direction, BlockValues& gaps) const noexcept {
    for (std::size_t p = 0; p < points.count; ++p) gaps[p] = 0.0;
    // A point that is outside a convex solid after the gap found so far leaves it earlier, by far more than rounding.
    constexpr double outside = -1e-9;  // [m]
    const double known = solid_->is_convex() ? 1.0 : 0.0;
    PointBlock ahead;
    BlockValues depth;
    ahead.count = points.count;
    for (std::size_t i = pending_count_, first = first_that_matters(); i-- > first;) {
        for (std::size_t p = 0; p < points.count; ++p) {
            ahead.x[p] = points.x[p] + known * gaps[p] * direction.x;
            ahead.y[p] = points.y[p] + known * gaps[p] * direction.y;
            ahead.z[p] = points.z[p] + known * gaps[p] * direction.z;
        }
        const Pose& tool_from = tool_from_body(i);
        solid_->depths(tool_from, ahead, depth);
        const Vec3 direction_in_tool = rotate(tool_from.rotation, direction);
        for (std::size_t p = 0; p < points.count; ++p)
            if (depth[p] >= outside)
                gaps[p] = std::max(gaps[p], solid_->travel_to_leave(tool_from * points[p], direction_in_tool));
    }
}

void CutTracker::raise_to_present(const PointBlock& points, BlockValues& distances, PendingWalls& walls) const noexcept {
    walls.fill(none);
    if (pending_count_ == 0 || points.count == 0) return;
    const std::size_t newest = pending_count_ - 1;

    // The distance is 1-Lipschitz. One point in the middle of all bounds how deep any of them can be in the newest, and
    // by as much as the older ones lie elsewhere, in those.
    Vec3 low = points[0], high = low;
    double least = distances[0];
    for (std::size_t p = 1; p < points.count; ++p) {
        low = {std::min(low.x, points.x[p]), std::min(low.y, points.y[p]), std::min(low.z, points.z[p])};
        high = {std::max(high.x, points.x[p]), std::max(high.y, points.y[p]), std::max(high.z, points.z[p])};
        least = std::min(least, distances[p]);
    }
    const double radius = 0.5 * length(high - low);
    const Vec3 middle = tool_from_body(newest) * (0.5 * (low + high));
    const double elsewhere = farthest_pending_ + largest_turn_ * (length(middle) + radius) + rounding;
    if (-solid_->distance(middle) + radius + elsewhere < least) return;

    BlockValues depth;
    std::array<std::uint8_t, block_capacity> lane;
    PointBlock concerned;
    solid_->depths(tool_from_body(newest), points, depth);
    for (std::size_t p = 0; p < points.count; ++p) {
        const bool may_be_deeper = depth[p] + elsewhere >= distances[p];
        if (depth[p] > distances[p]) {
            distances[p] = depth[p];
            walls[p] = static_cast<std::uint8_t>(newest);
        }
        if (!may_be_deeper) continue;
        lane[concerned.count] = static_cast<std::uint8_t>(p);
        concerned.add(points[p]);
    }
    for (std::size_t i = 0; i < newest && concerned.count > 0; ++i) {
        solid_->depths(tool_from_body(i), concerned, depth);
        for (std::size_t p = 0; p < concerned.count; ++p) {
            if (!(depth[p] > distances[lane[p]])) continue;
            distances[lane[p]] = depth[p];
            walls[lane[p]] = static_cast<std::uint8_t>(i);
        }
    }
}

Vec3 CutTracker::normal_of(std::uint8_t wall, Vec3 point) const noexcept {
    return rotate(pending(wall).to.rotation, solid_->way_in(tool_from_body(wall) * point));
}

bool CutTracker::removes_bone(const Pose& at) const noexcept {
    if (!is_in_reach_of_bone(*body_, *solid_, at, body_->grid().clamp(), CutOnly::yes)) return false;
    if (!has_removed_) return true;

    // Past the deepest front so far: new bone for certain, however thin the slice.
    if ((inverse(last_removing_) * at).position.z > 1e-9) return true;

    // Elsewhere: does the outline stand in present bone by more than the wall is exact?
    const double limit = -wall_voxels * body_->grid().spacing;
    const auto& outline = solid_->outline();
    for (std::size_t i = 0; i + 1 < outline.size(); ++i)
        for (int step = 0; step <= 4; ++step) {
            const double t = 0.25 * step;
            const double r = outline[i].radius + t * (outline[i + 1].radius - outline[i].radius);
            const double z = outline[i].z + t * (outline[i + 1].z - outline[i].z);
            for (const auto& direction : azimuths) {
                const Vec3 p = at * Vec3{r * direction[0], r * direction[1], z};
                if (!body_->region.contains(p)) continue;
                const BrickPlace place = locate(body_->grid(), p);
                if (std::max(body_->surface.at(place), committed_->at(place)) < limit && depth_in_pending(p) < limit)
                    return true;
            }
        }
    return false;
}

}  // namespace kerf
