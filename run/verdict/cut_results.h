// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "bone/measure/cut_wall.h"
#include "core/haptics/scene/simulation.h"
#include "run/scene.h"
#include "run/verdict/step_monitor.h"

/// What the cut of a step, and no earlier one, has left.
namespace kerf {

/// What was cut already when a step began.
class CutBefore {
public:
    void begin(const PresentBone& bone) {
        cut_.clear();
        came_from_.clear();
        for (std::size_t body = 0; body < bone.count(); ++body) {
            cut_.push_back(bone.cut(body));
            came_from_.push_back(body);
        }
    }
    /// There are other bodies now: those that came apart since then were part of others.
    void follow(const PresentBone& bone) {
        came_from_.resize(std::min(came_from_.size(), bone.count()));
        for (std::size_t body = came_from_.size(); body < bone.count(); ++body) {
            const std::size_t before = bone.piece(body).came_off;
            if (before == body) cut_.push_back(CutField(*bone.piece(body).bone, 0));  // there was no such bone
            came_from_.push_back(before == body ? cut_.size() - 1 : came_from_[before]);
        }
    }
    /// Whether a point of a body may lie on an earlier cut: within half a voxel of it.
    [[nodiscard]] bool reaches(const Body& bone, std::size_t body, Vec3 p) const {
        return cut_[came_from_[body]].at(locate(bone, p)) > -0.5 * bone.grid().spacing;
    }
    /// Share of a body's bone at a point that was gone already [–].
    [[nodiscard]] double share_gone(const Body& bone, std::size_t body, Vec3 p) const {
        return std::clamp(0.5 + cut_[came_from_[body]].at(locate(bone, p)) / bone.grid().spacing, 0.0, 1.0);
    }

private:
    std::vector<CutField> cut_;
    std::vector<std::size_t> came_from_;
};

/// The wall that a step has cut into all bodies, each seen where it was before it moved. Nothing without a plane.
/// [main]
[[nodiscard]] std::optional<CutWall> wall_of(const Scene& scene, const Simulation& simulation, const CutBefore& before,
                                             const StepMonitor& monitor, std::size_t step);

/// The hole that a step has left in the body that its axis belongs to, seen where that body was before it moved.
/// Nothing for a blade.   [main]
[[nodiscard]] std::optional<HoleResult> hole_of(const Scene& scene, const Simulation& simulation,
                                                const CutBefore& before, const StepMonitor& monitor, std::size_t step);

/// The implant that a step leaves in that body, where the tool is now. Nothing for one that has cut no bone.   [main]
[[nodiscard]] std::optional<HoleResult> screw_of(const Scene& scene, const Simulation& simulation,
                                                 const StepMonitor& monitor, std::size_t step);
/// The same of an implant that lies in a body at a pose. Nothing of it where it is at more than 60° to the axis. [main]
/// @param frame   of the step, in the body's frame
[[nodiscard]] HoleResult screw_at(const Scene& scene, std::size_t step, const AxisFrame& frame, const Body& body,
                                  const Pose& body_from_screw);

}  // namespace kerf
