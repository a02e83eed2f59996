// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/haptics/simulation.h"
#include "studies/chart/scene.h"

/// Ways to make the force of a drill, one beside the other. For training and research; not for diagnosis, planning or
/// deciding treatment.
namespace kerf::chart {

/// What came of one tick.
struct Felt {
    Vec6 wrench{};                ///< bone on tool about its tip, tool frame [N, N·m]
    Pose from = identity_pose();  ///< where the tool was when it was felt
    double rate = 0.0;            ///< [m/s] along the shaft that it was felt at
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
    int points = 31;          ///< per lip
    Vec3 offset{};            ///< [voxels] of the grid
};

/// Which of them a curve sweeps.
enum class Knob { spacing, points };

struct Method {
    std::string id{};     ///< "M8"
    std::string title{};  ///< for people
    Knob knob = Knob::spacing;
    std::vector<Fineness> sweep{};  ///< coarse to fine
    bool is_as_printed = false;     ///< with the paper's own slips
    bool is_solved = false;         ///< the tool finds its own motion: only its thrust can be held against the law
    bool is_calibrated = false;     ///< its one constant is set in whole cortical bone
    int first_lag = 0;              ///< [ticks] after which its spindle turns
    /// Of solved methods: what is solved with.
    std::function<ToolSetup(const Scene&, const Fineness&)> setup{};
    /// Of solved methods: the same law at the rate of a prescribed motion, to replay theirs on a finer grid.
    std::function<std::unique_ptr<Run>(const Scene&, const Fineness&)> replay{};
    /// @param gain  on its force [–]; 1 where it is not calibrated
    std::function<std::unique_ptr<Run>(const Scene&, const Fineness&, double gain)> start{};
};

/// Whether its tool is pushed aside, so that no law of a straight way holds.
[[nodiscard]] inline bool walks(const Method& method, const Scene& scene) noexcept {
    return method.is_solved && scene.is_oblique;
}

[[nodiscard]] std::string knob_text(const Method& method, const Fineness& fineness);

}  // namespace kerf::chart
