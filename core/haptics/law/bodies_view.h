// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "core/haptics/law/body_threads.h"
#include "core/haptics/law/held_body.h"

/// All bodies near a tool, queried as one bone. Plugins see bone through this view.
namespace kerf {

/// Answers queries of several bodies. For each point, `sample` returns the sample of the cuttable body in which the
/// point has the largest engagement. `nearest` returns the surface point of the body with the smallest signed distance,
/// metal included. Each answer contains the body's id, −1 if no body is near. Points and answers are in the tool frame.
class BodiesView {
public:
    /// Pre: `threads` outlives this view.
    BodiesView(const Body& first, const BodyThreads& threads);
    BodiesView(const BodiesView&) = delete;
    BodiesView& operator=(const BodiesView&) = delete;

    /// Sets the tool pose for the queries until the next call. Selects the bodies near the tool that are not held, and
    /// sets `is_near` of all bodies.   [haptic, nonblocking]
    void place(std::span<const std::unique_ptr<LiveBody>> bodies, const ToolSolid& tool, const Pose& world_from_tool,
               const HeldBody& held) noexcept;
    [[nodiscard]] const kerf_bone_query& query() const noexcept { return query_; }
    [[nodiscard]] std::span<LiveBody* const> near() const noexcept { return {near_.data(), near_count_}; }

    void sample(const Vec3* points, std::uint32_t count, Directions directions, kerf_bone_sample* out) const noexcept;
    void sample(const Vec3* points, std::uint32_t count, Vec3 direction, kerf_bone_sample* out) const noexcept {
        sample(points, count, Directions::one(direction), out);
    }
    void nearest(const Vec3* points, std::uint32_t count, kerf_surface_point* out) const noexcept;
    std::uint32_t threads(kerf_thread* out, std::uint32_t capacity) const noexcept;
    /// Returns the poses of the tool in the near bodies that can be cut.
    [[nodiscard]] std::span<const ToolInBody> tool_poses() const noexcept {
        return {tool_poses_.data(), cuttable_count_};
    }

private:
    static void sample_entry(const kerf_bone* bone, const kerf_vec3* points, std::uint32_t count,
                             const kerf_vec3* directions, std::uint32_t direction_count, kerf_bone_sample* out) {
        reinterpret_cast<const BodiesView*>(bone)->sample(points, count,
                                                          Directions::given(directions, direction_count, count), out);
    }
    static void nearest_entry(const kerf_bone* bone, const kerf_vec3* points, std::uint32_t count,
                              kerf_surface_point* out) {
        reinterpret_cast<const BodiesView*>(bone)->nearest(points, count, out);
    }

    static std::uint32_t threads_entry(const kerf_bone* bone, kerf_thread* out, std::uint32_t capacity) {
        return reinterpret_cast<const BodiesView*>(bone)->threads(out, capacity);
    }

    const BodyThreads* threads_;
    std::array<LiveBody*, max_bodies> near_{};
    std::array<ToolInBody, max_bodies> tool_poses_{};  ///< poses of the tool in the near cuttable bodies
    std::size_t near_count_ = 0, cuttable_count_ = 0;  ///< cuttable bodies come first
    kerf_bone_query query_{};
};

}  // namespace kerf
