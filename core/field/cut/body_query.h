// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/field/cut/pending_surface.h"

/// The bone of one body at one tick, as a plugin queries it: batch queries in the tool frame, valid for any point.
///
/// Queries are computed in blocks, stage by stage: cells of the grid, then surface and cut, then tissues, or pending
/// cuts where they may change an answer. Each point gets the same bits as in a query of its own.
namespace kerf {

class BodyQuery {
public:
    BodyQuery(const Body& body, const CutField& committed, const CutTracker& tracker)
        : body_(&body), committed_(&committed), tracker_(&tracker), grid_(body.grid(), body.region, frame_) {
        query_.size = sizeof(kerf_bone_query);
        query_.reach = body.grid().clamp();
        query_.tissue_count = static_cast<std::uint32_t>(body.materials.size());
        query_.sample = &BodyQuery::sample_entry;
        query_.nearest = &BodyQuery::nearest_entry;
        query_.bone = reinterpret_cast<const kerf_bone*>(this);
    }
    BodyQuery(const BodyQuery&) = delete;
    BodyQuery& operator=(const BodyQuery&) = delete;

    /// Sets the body index that answers report.
    void name(std::int32_t body_id) noexcept { body_id_ = body_id; }
    /// Sets the pose at which points are queried, until the next call.   [haptic, nonblocking]
    void place(const Pose& body_from_tool) noexcept {
        body_from_tool_ = body_from_tool;
        frame_ = frame_of(body_from_tool);
        grid_ = GridFrame(body_->grid(), body_->region, frame_);
    }
    [[nodiscard]] const kerf_bone_query& query() const noexcept { return query_; }

    /// Samples points of edges in the tool frame: engagement in the committed cut, gap to the front, tissues. The gap
    /// is measured along the point's direction.   [haptic, nonblocking]
    void sample(const Vec3* points, std::uint32_t count, Directions directions, kerf_bone_sample* out) const noexcept;
    void sample(const Vec3* points, std::uint32_t count, Vec3 direction, kerf_bone_sample* out) const noexcept {
        sample(points, count, Directions::one(direction), out);
    }
    /// Writes distance, normal and body of the present surface for contact points in the tool frame.
    /// [haptic, nonblocking]
    void nearest(const Vec3* points, std::uint32_t count, kerf_surface_point* out) const noexcept;
    /// Returns the signed distance to the present surface [m], negative inside, within ± clamp.   [haptic, nonblocking]
    [[nodiscard]] double present_distance(Vec3 point_in_body) const noexcept;

private:
    void sample_block(const Vec3* points, std::size_t count, Directions directions,
                      kerf_bone_sample* out) const noexcept;
    void nearest_block(PendingSurface& pending, const Surface& surface, const Vec3* points, std::size_t count,
                       kerf_surface_point* out) const noexcept;

    static void sample_entry(const kerf_bone* bone, const kerf_vec3* points, std::uint32_t count,
                             const kerf_vec3* directions, std::uint32_t direction_count, kerf_bone_sample* out) {
        reinterpret_cast<const BodyQuery*>(bone)->sample(points, count,
                                                         Directions::given(directions, direction_count, count), out);
    }
    static void nearest_entry(const kerf_bone* bone, const kerf_vec3* points, std::uint32_t count,
                              kerf_surface_point* out) {
        reinterpret_cast<const BodyQuery*>(bone)->nearest(points, count, out);
    }

    const Body* body_;
    const CutField* committed_;
    const CutTracker* tracker_;
    Pose body_from_tool_ = identity_pose();
    Frame frame_ = frame_of(identity_pose());  ///< of body_from_tool_
    GridFrame grid_;
    std::int32_t body_id_ = 0;
    kerf_bone_query query_{};
};

}  // namespace kerf
