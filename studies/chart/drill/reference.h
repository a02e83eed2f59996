// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "studies/chart/drill/scene.h"

/// What is right, independent of every method. For training and research; not for diagnosis, planning or deciding
/// treatment.
namespace kerf::chart {

/// Which stretches of the edges lie in which tissue at a pose: borders are found along each edge by bisection, to 1e-12
/// of its length. A tissue that is entered and left within 1/64 of an edge is not seen.   [any] pure.
[[nodiscard]] Engaged exactly_engaged(const ExactBone& bone, const Drill& drill, const CuttingLaw& law,
                                      const Pose& body_from_tool, double angle);

/// The exact law along one straight way, with a memory of how deep the drill has been: behind the front there is
/// nothing to cut.
class ExactForce {
public:
    /// Both must outlive this.
    ExactForce(const Scene& scene, const CuttingLaw& law) : scene_(&scene), law_(&law) {}

    /// While the tip advances at `rate` [m/s] from a pose, the first lip at `angle` [rad]; engagement as at that pose.
    /// About the tip, tool frame [N, N·m].
    ///
    ///     per lip (to − max(from, deepest so far)) / (n_lips n dt),  nothing when that is not positive
    [[nodiscard]] Vec6 wrench(const Pose& body_from_tool, double rate, double angle);

    /// Whether the feed of the last answer stays below what the relief behind the lips allows: beyond it the heel
    /// carries, which is not part of the edges' law.
    [[nodiscard]] bool is_within_relief() const noexcept;
    [[nodiscard]] double deepest() const noexcept { return deepest_; }  ///< [m] where the tip has been

private:
    const Scene* scene_;
    const CuttingLaw* law_;
    double deepest_ = -1.0, advance_ = 0.0;
};

/// Bone taken by a drill that went straight in until its tip was at `deepest` [m]: cone and cylinder through the exact
/// bone, by the midpoint rule in the drill's cylinder coordinates, Richardson-extrapolated from two grids [m³].
/// `error`, if given, gets the difference that the extrapolation made.
[[nodiscard]] double exact_volume(const Scene& scene, double deepest, double* error = nullptr);

}  // namespace kerf::chart
