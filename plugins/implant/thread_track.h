// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "kerf/plugin.hpp"
#include "screw_thread.h"

namespace kerf::implant {

/// The thread in bone that a tool turns in: an existing one, or one that the tool cuts. z of the thread's frame points
/// into the bone.
class ThreadTrack {
public:
    /// Returns the thread that the tool is in, or none. A thread with another lead, offset or tilted axis is another
    /// thread.
    /// @param held  number of the thread that the tool is in, which it keeps; KERF_NEW_THREAD: none
    [[nodiscard]] static ThreadTrack found(const BoneQuery& bone, const ScrewThread& tool,
                                           std::uint32_t held = KERF_NEW_THREAD) noexcept;
    /// Returns a new thread in a body of the bone that begins at `leading` of the tool's z [m].
    [[nodiscard]] static ThreadTrack begun(const ScrewThread& tool, double leading, std::int32_t body) noexcept;

    [[nodiscard]] bool is_there() const noexcept { return is_there_; }
    /// Returns whether a thread of another lead runs at the tool.
    [[nodiscard]] bool is_crossed() const noexcept { return is_crossed_; }
    [[nodiscard]] kerf_thread& thread() noexcept { return thread_; }
    [[nodiscard]] const kerf_thread& thread() const noexcept { return thread_; }

    /// Returns z of a point of the tool in the thread's frame [m].
    [[nodiscard]] double depth_of(Vec3 point_in_tool) const noexcept { return (thread_from_tool_ * point_in_tool).z; }
    /// Returns whether a crest at that depth runs in a groove.
    [[nodiscard]] bool is_cut_at(double z) const noexcept {
        return is_there_ && z >= thread_.from - before && z <= std::max(thread_.to, thread_.tapped_to) + just;
    }
    /// Returns the fraction of the thread's depth that a tap has removed at depth `z` [–].
    [[nodiscard]] double fraction_tapped(double z, double outer_radius, double core_radius) const noexcept;
    /// Returns the slip of the bone at depth `z` [m].
    [[nodiscard]] double slip_at(double z) const noexcept { return thread_.slip[bin_of(z)]; }
    void add_slip(double from, double to, double slip) noexcept;  ///< between two depths

    /// Offset of the tool's axis from the thread's at `z` of the tool [m].
    [[nodiscard]] Vec3 offset(double z) const noexcept;
    /// Angle of the tool to the thread's axis [rad], about its x and y.
    [[nodiscard]] Vec3 inclination() const noexcept { return {axis_.y, -axis_.x, 0.0}; }
    /// Moves the thread's axis in the bone by an offset [m] at `z` of the tool [m], and tilts it by an angle [rad].
    void yield_plastically(Vec3 offset, Vec3 inclination, double z) noexcept;

private:
    static constexpr double before = 0.3e-3;  ///< [m] of the helix that a point represents
    static constexpr double just = 20e-6;     ///< [m] largest advance in a tick, whose groove is cut at its end
    explicit ThreadTrack(const kerf_thread& thread) noexcept;
    ThreadTrack() = default;
    [[nodiscard]] std::size_t bin_of(double z) const noexcept;

    kerf_thread thread_{};
    Pose thread_from_tool_ = identity_pose();
    Vec3 axis_{0, 0, 1};  ///< of the thread, tool frame
    bool is_there_ = false, is_crossed_ = false;
};

}  // namespace kerf::implant
