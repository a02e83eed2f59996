// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "bone/measure/cut_wall.h"
#include "core/haptics/scene/simulation.h"
#include "run/scene.h"
#include "run/verdict/step_monitor.h"

/// Measurements of the cut of one step, without earlier cuts.
namespace kerf::run {

/// The cut when a step began.
class EarlierCut {
public:
    void begin(const PresentBone& bone) {
        cut_.clear();
        source_cut_.clear();
        for (std::size_t body = 0; body < bone.count(); ++body) {
            cut_.push_back(bone.cut(body));
            source_cut_.push_back(body);
        }
    }
    /// Updates the bodies: each separated body was a part of another one before.
    void follow(const PresentBone& bone) {
        source_cut_.resize(std::min(source_cut_.size(), bone.count()));
        for (std::size_t body = source_cut_.size(); body < bone.count(); ++body) {
            const std::size_t before = bone.piece(body).separated_from;
            if (before == body) cut_.push_back(CutField(*bone.piece(body).bone, 0));  // there was no such bone
            source_cut_.push_back(before == body ? cut_.size() - 1 : source_cut_[before]);
        }
    }
    /// Returns whether a point of a body may lie on an earlier cut: it is within half a voxel of it.
    [[nodiscard]] bool reaches(const Body& bone, std::size_t body, Vec3 p) const {
        return cut_[source_cut_[body]].at(locate(bone, p)) > -0.5 * bone.grid().spacing;
    }
    /// Returns the fraction of a body's bone at a point that was removed before [–].
    [[nodiscard]] double fraction_removed(const Body& bone, std::size_t body, Vec3 p) const {
        return std::clamp(0.5 + cut_[source_cut_[body]].at(locate(bone, p)) / bone.grid().spacing, 0.0, 1.0);
    }

private:
    std::vector<CutField> cut_;
    std::vector<std::size_t> source_cut_;
};

/// Returns the wall that a step has cut, of all bodies at their poses before they moved. Nothing without a plane.
/// [main]
[[nodiscard]] std::optional<bone::CutWall> wall_of(const Scene& scene, const Simulation& simulation,
                                                   const EarlierCut& before, const StepMonitor& monitor,
                                                   std::size_t step);

/// Returns the hole that a step has left in the body that owns its axis, at the body's pose before it moved. Nothing
/// for a blade.   [main]
[[nodiscard]] std::optional<HoleResult> hole_of(const Scene& scene, const Simulation& simulation,
                                                const EarlierCut& before, const StepMonitor& monitor, std::size_t step);

/// Returns the implant that a step leaves in that body, at the tool's present pose. Nothing for a tool that has cut no
/// bone.   [main]
[[nodiscard]] std::optional<HoleResult> screw_of(const Scene& scene, const Simulation& simulation,
                                                 const StepMonitor& monitor, std::size_t step);
/// Returns the result for an implant at a pose in a body. Empty if it is at more than 60° to the axis. [main]
/// @param frame   of the step, body frame
[[nodiscard]] HoleResult screw_at(const Scene& scene, std::size_t step, const AxisFrame& frame, const Body& body,
                                  const Pose& body_from_screw);

}  // namespace kerf::run
