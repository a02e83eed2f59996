// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/haptics/scene/simulation.h"
#include "studies/chart/setting.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::chart {

/// What came of one tick.
struct Felt {
    Vec6 wrench{};                ///< bone on tool about its tip, tool frame [N, N·m]
    Pose from = identity_pose();  ///< where the tool was when it was felt
    Vec6 rate{};                  ///< [m/s, rad/s] that it was felt at, tool frame
    double cost = 0.0;            ///< [µs] of the haptic loop, on the processor
    double commanded = 0.0;       ///< [N, device] against the feed, after the loop's own limits; solved methods only
};

/// One method at work in one bone.
class Run {
public:
    virtual ~Run() = default;
    /// One tick: the tool, or the hand that leads it, comes to `next`.
    virtual Felt tick(const Pose& next) = 0;
    virtual void command_spindle(double revolutions_per_second) = 0;
    /// All bone that was taken [m³]. Ends the run.
    [[nodiscard]] virtual double removed_volume() = 0;
};

/// How fine a method's grid and its points are.
struct Fineness {
    double spacing = 0.5e-3;  ///< [m]
    int points = 31;          ///< of a drill: per lip
    Vec3 offset{};            ///< [voxels] of the grid
};

/// Shifts of grids in parts of a voxel that have nothing to do with each other; the fifth is the first again.
[[nodiscard]] constexpr Vec3 grid_shift(int grid) noexcept {
    constexpr Vec3 shifts[] = {{0.31, 0.17, 0.73}, {0.87, 0.59, 0.13}, {0.05, 0.91, 0.47}, {0.63, 0.37, 0.89}};
    return shifts[grid % 4];
}

/// Which of them a curve sweeps.
enum class Knob { spacing, points };
[[nodiscard]] std::string knob_text(Knob knob, const Fineness& fineness);

/// The rate at which a tool goes from one pose to another in a tick, in its own frame [m/s, rad/s].   [any] pure.
[[nodiscard]] inline Vec6 rate_between(const Pose& from, const Pose& next) noexcept {
    const Pose from_next = inverse(from) * next;
    return make_vec6((1.0 / dt) * from_next.position, (1.0 / dt) * small_rotation_vector(from_next.rotation));
}

}  // namespace kerf::chart
