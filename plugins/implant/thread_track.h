// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "kerf/plugin.hpp"
#include "screw_thread.h"

namespace kerf::implant {

/// The thread in bone that a tool turns in: one that is there, or the one that it cuts itself. z of the thread's frame
/// points into the bone.
class ThreadTrack {
public:
    /// Looks for the thread that the tool is in. Returns none where there is none: of another lead, beside the tool or
    /// askew to it is another thread.
    /// @param held  number of the thread that the tool is in already, which it does not lose; KERF_NEW_THREAD: none
    [[nodiscard]] static ThreadTrack found(const BoneQuery& bone, const ScrewThread& tool,
                                           std::uint32_t held = KERF_NEW_THREAD) noexcept;
    /// One that begins in a body of the bone, at `leading` of the tool's z [m].
    [[nodiscard]] static ThreadTrack begun(const ScrewThread& tool, double leading, std::int32_t body) noexcept;

    [[nodiscard]] bool is_there() const noexcept { return is_there_; }
    /// A thread of another lead runs where the tool is.
    [[nodiscard]] bool is_crossed() const noexcept { return is_crossed_; }
    [[nodiscard]] kerf_thread& thread() noexcept { return thread_; }
    [[nodiscard]] const kerf_thread& thread() const noexcept { return thread_; }

    /// [m] of z of a place of the tool.
    [[nodiscard]] double depth_of(Vec3 place_in_tool) const noexcept { return (thread_from_tool_ * place_in_tool).z; }
    /// Whether a crest at that depth runs in a groove.
    [[nodiscard]] bool is_cut_at(double z) const noexcept {
        return is_there_ && z >= thread_.from - before && z <= std::max(thread_.to, thread_.tapped_to) + just;
    }
    /// How much of a thread's depth a tap has taken out there [–].
    [[nodiscard]] double share_tapped(double z, double outer_radius, double core_radius) const noexcept;
    /// The slip of the bone there [m].
    [[nodiscard]] double slip_at(double z) const noexcept { return thread_.slip[bin_of(z)]; }
    void add_slip(double from, double to, double slip) noexcept;  ///< between two depths

    /// Offset of the tool's axis from the thread's at `z` of the tool [m].
    [[nodiscard]] Vec3 beside(double z) const noexcept;
    /// Angle of the tool to the thread's axis [rad], about its x and y.
    [[nodiscard]] Vec3 askew() const noexcept { return {axis_.y, -axis_.x, 0.0}; }
    /// The bone gives way: the thread's axis moves by `beside` at `z` of the tool [m], and turns by `askew` [rad].
    void give_way(Vec3 beside, Vec3 askew, double z) noexcept;

private:
    static constexpr double before = 0.3e-3;  ///< [m] a place stands for so much of the helix
    static constexpr double just = 20e-6;     ///< [m] that a tick turns in at most: its groove is cut at its end
    explicit ThreadTrack(const kerf_thread& thread) noexcept;
    ThreadTrack() = default;
    [[nodiscard]] std::size_t bin_of(double z) const noexcept;

    kerf_thread thread_{};
    Pose thread_from_tool_ = identity_pose();
    Vec3 axis_{0, 0, 1};  ///< of the thread, tool frame
    bool is_there_ = false, is_crossed_ = false;
};

}  // namespace kerf::implant
