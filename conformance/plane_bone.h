// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/haptics/law/body_threads.h"
#include "kerf/abi.h"
#include "kerf/math.hpp"

namespace kerf::conformance {

/// A plate of bone whose face is z = 0, known exactly: what the host answers of uncut bone, without a grid. It counts
/// what it is asked.
class PlaneBone {
public:
    enum class Shape { plate, air, endless };
    struct Settings {
        Shape shape = Shape::plate;
        double thickness = 1.0;          ///< [m]
        double density = 1850.0;         ///< [kg/m³]
        double voxel = 0.25e-3;          ///< [m] edges of bone are as soft as on such a grid
        std::uint32_t tissues = 2;       ///< the first as dense as said, the others by `others`
        double fraction_of_first = 1.0;  ///< [–] the rest is the next tissue
        double others = 0.5;             ///< [–] their density divided by that of the first
        std::uint32_t first = 0;         ///< index of the first tissue
        double gap = 0.0;                ///< [m] to uncut bone, of every sample
        std::uint16_t body = 0;          ///< index of the body
        bool is_split = false;           ///< what lies at x > 0 is the next body
    };
    explicit PlaneBone(const Settings& settings);
    PlaneBone(const PlaneBone&) = delete;
    PlaneBone& operator=(const PlaneBone&) = delete;

    /// Points are asked about at this pose from now on.   [any]
    void place(const Pose& bone_from_tool) noexcept { bone_from_tool_ = bone_from_tool; }
    [[nodiscard]] const kerf_bone_query& query() const noexcept { return query_; }

    /// Keeps a thread that a law has left in it. Returns whether it can be kept.
    bool leave(const kerf_thread& thread) noexcept {
        const ToolInBody here{settings_.body, bone_from_tool_};
        return threads_.leave(thread, {&here, 1});
    }
    void forget_threads() noexcept { threads_ = {}; }

    struct Counts {
        std::uint32_t queries = 0, points = 0;
    };
    /// What was asked since the last call.
    [[nodiscard]] Counts take_counts() noexcept;

private:
    [[nodiscard]] double distance_at(Vec3 point_in_tool, Vec3* normal_in_tool) const noexcept;
    [[nodiscard]] std::int32_t body_at(Vec3 point_in_tool) const noexcept;
    void sample(const Vec3* points, std::uint32_t count, kerf_bone_sample* out) noexcept;
    void nearest(const Vec3* points, std::uint32_t count, kerf_surface_point* out) noexcept;
    static void sample_entry(const kerf_bone* bone, const kerf_vec3* points, std::uint32_t count, const kerf_vec3*,
                             std::uint32_t, kerf_bone_sample* out);
    static void nearest_entry(const kerf_bone* bone, const kerf_vec3* points, std::uint32_t count,
                              kerf_surface_point* out);
    static std::uint32_t threads_entry(const kerf_bone* bone, kerf_thread* out, std::uint32_t capacity);

    Settings settings_;
    Pose bone_from_tool_ = identity_pose();
    BodyThreads threads_;
    Counts counts_;
    kerf_bone_query query_{};
};

}  // namespace kerf::conformance
