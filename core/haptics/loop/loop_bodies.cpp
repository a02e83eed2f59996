// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/loop/loop_bodies.h"

#include <algorithm>

#include "core/field/cut/reach.h"
#include "core/haptics/loop/free_pose.h"
#include "kerf/assert.hpp"

namespace kerf {

namespace {

// Maximum number of records of a tick, an undo or redo, and a subtraction together.
constexpr std::size_t closed_capacity = (2 * 16 + 3) * max_bodies;

}  // namespace

LoopBodies::LoopBodies(const Body& first, const ToolOutline& outline) : view_(first, threads_) {
    bodies_.reserve(max_bodies);
    bodies_.push_back(
        std::make_unique<LiveBody>(std::uint16_t{0}, first, CutField(first, live_reserve), outline.cutting));
    closed_.reserve(closed_capacity);
}

bool LoopBodies::is_in_reach(const ToolNow& tool, double margin) const noexcept {
    if (held_.is_any() && held_.is_near_another(bodies_, tool.world_from_tool, margin)) return true;
    return std::any_of(bodies_.begin(), bodies_.end(), [&](const auto& body) {
        return body->is_present && !held_.contains(body->id) &&
               is_in_reach_of_bone(*body->bone, tool.outline().whole, body->body_from(tool.world_from_tool), margin);
    });
}

bool LoopBodies::is_behind() const noexcept {
    return std::any_of(bodies_.begin(), bodies_.end(), [](const auto& body) { return body->tracker.is_behind(); });
}

double LoopBodies::distance_out_of_bone(const ToolNow& tool) const {
    double distance = 0.0;
    for (const auto& body : bodies_)
        if (body->is_present)
            distance = std::max(
                distance, retreat_distance(*body->bone, tool.outline().whole, body->body_from(tool.world_from_tool))
                              .value_or(0.0));
    return distance;
}

void LoopBodies::begin_tick() noexcept {
    closed_.clear();
    bricks_left_ = CutTracker::max_bricks;
}

void LoopBodies::cut(const ToolNow& tool, bool is_cutting, bool is_at_front) noexcept {
    held_.move(bodies_, tool.world_from_tool);
    for (const auto& body : bodies_) {
        const Pose body_from_tool = body->body_from(tool.world_from_tool);
        CutTracker& tracker = body->tracker;
        const bool is_cut = is_cutting && body->is_near && body->is_cuttable;
        if (is_cut) {
            take_closed(tracker, tracker.advance(body_from_tool, tool.tick));
        } else {
            take_closed(tracker, tracker.close(tool.tick));  // the stretch up to the last pose becomes a record
            tracker.restart(body_from_tool);
        }
        tracker.commit_passed(body_from_tool, is_cut && is_at_front, bricks_left_);
        bricks_left_ -= tracker.last_bricks();
    }
    update_view(tool);
}

void LoopBodies::restart_stretches(const ToolNow& tool) noexcept {
    for (const auto& body : bodies_) body->tracker.restart(body->body_from(tool.world_from_tool));
    update_view(tool);
}

void LoopBodies::take_tool(const ToolNow& tool) {
    for (const auto& body : bodies_)
        body->tracker.take_tool(tool.outline().cutting, static_cast<std::uint16_t>(tool.tools.in_hand()));
    held_.release();
}

bool LoopBodies::hold(std::size_t body, const Pose& world_from_tool) noexcept {
    if (body >= bodies_.size() || !bodies_[body]->is_present) return true;
    if (bodies_.size() == 1) return false;
    held_.take(bodies_, body, world_from_tool);
    return true;
}

bool LoopBodies::keep(const kerf_thread& thread) noexcept {
    const bool is_new = thread.number == KERF_NEW_THREAD;
    return threads_.leave(thread, view_.tool_poses()) || !is_new || !threads_.is_full();
}

void LoopBodies::take_closed(CutTracker& tracker, int count) noexcept {
    for (int i = 0; i < count; ++i) {
        const CutRecord& record = tracker.closed(i);
        KERF_ASSERT(closed_.size() < closed_.capacity(), "the capacity suffices for all parts and bodies");
        closed_.push_back(record);
        if (record.removes) ++removing_;
    }
}

void LoopBodies::close_stretches(std::uint64_t tick) noexcept {
    for (const auto& body : bodies_) take_closed(body->tracker, body->tracker.close(tick));
}

void LoopBodies::reserve(std::size_t count) {
    for (const auto& body : bodies_) body->committed.reserve(count);
}

void LoopBodies::flush() {
    for (const auto& body : bodies_) body->tracker.flush();
}

}  // namespace kerf
