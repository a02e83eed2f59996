// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/law/bodies_view.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace kerf {

BodiesView::BodiesView(const Body& first, const BodyThreads& threads) : threads_(&threads) {
    query_.size = sizeof(kerf_bone_query);
    query_.reach = first.grid().clamp();
    query_.tissue_count = static_cast<std::uint32_t>(first.materials.size());
    query_.sample = &BodiesView::sample_entry;
    query_.nearest = &BodiesView::nearest_entry;
    query_.threads = &BodiesView::threads_entry;
    query_.bone = reinterpret_cast<const kerf_bone*>(this);
}

void BodiesView::place(std::span<const std::unique_ptr<LiveBody>> bodies, const ToolSolid& tool,
                       const Pose& world_from_tool, const HeldBody& held) noexcept {
    near_count_ = 0;
    for (const auto& body : bodies) {
        const Pose body_from_tool = body->body_from(world_from_tool);
        body->view.place(body_from_tool);
        body->is_near = body->is_present && !held.contains(body->id);
        if (bodies.size() > 1 && body->is_near) {
            const auto box = tool.box(body_from_tool);
            body->is_near = body->is_near_box(box.low, box.high, body->bone->grid().clamp());
        }
        if (!body->is_near || !body->is_cuttable) continue;
        tool_poses_[near_count_] = {body->id, body_from_tool};
        near_[near_count_++] = body.get();
    }
    cuttable_count_ = near_count_;
    for (const auto& body : bodies)
        if (body->is_near && !body->is_cuttable) near_[near_count_++] = body.get();
}

void BodiesView::sample(const Vec3* points, std::uint32_t count, Directions directions,
                        kerf_bone_sample* out) const noexcept {
    if (cuttable_count_ == 0) {
        for (std::uint32_t i = 0; i < count; ++i) {
            out[i] = kerf_bone_sample{};
            out[i].body = -1;
        }
        return;
    }
    near_[0]->view.sample(points, count, directions, out);
    std::array<kerf_bone_sample, block_capacity> other;
    for (std::size_t n = 1; n < cuttable_count_; ++n)
        for (std::uint32_t first = 0; first < count; first += block_capacity) {
            const auto some = std::min(static_cast<std::uint32_t>(block_capacity), count - first);
            near_[n]->view.sample(points + first, some, directions.from(first), other.data());
            for (std::uint32_t i = 0; i < some; ++i)
                if (other[i].engagement > out[first + i].engagement) out[first + i] = other[i];
        }
}

std::uint32_t BodiesView::threads(kerf_thread* out, std::uint32_t capacity) const noexcept {
    return threads_->write(tool_poses(), out, capacity);
}

void BodiesView::nearest(const Vec3* points, std::uint32_t count, kerf_surface_point* out) const noexcept {
    if (near_count_ == 0) {
        for (std::uint32_t i = 0; i < count; ++i) {
            out[i] = kerf_surface_point{};
            out[i].distance = query_.reach;
            out[i].body = -1;
        }
        return;
    }
    near_[0]->view.nearest(points, count, out);
    std::array<kerf_surface_point, block_capacity> other;
    for (std::size_t n = 1; n < near_count_; ++n)
        for (std::uint32_t first = 0; first < count; first += block_capacity) {
            const auto some = std::min(static_cast<std::uint32_t>(block_capacity), count - first);
            near_[n]->view.nearest(points + first, some, other.data());
            for (std::uint32_t i = 0; i < some; ++i)
                if (other[i].distance < out[first + i].distance) out[first + i] = other[i];
        }
}

}  // namespace kerf
