// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/field/cut/cut_field.h"
#include "core/haptics/law/tool.h"

namespace kerf::run {

/// The bone close around the thread of an implant, as points of its body's frame that were bone when it was left.
class HeldBone {
public:
    /// Samples circles one voxel outside the thread, one voxel apart along it. An implant without a thread has none.
    /// @param body_from_implant   pose in the body's frame   [main]
    [[nodiscard]] static HeldBone around(const ToolOutline& implant, const Pose& body_from_implant, const Body& body,
                                         const CutField& cut);

    /// Returns the part of these points that still is bone, 0 … 1; 1 without points.   [main]
    [[nodiscard]] double part_left(const Body& body, const CutField& cut) const;

private:
    std::vector<Vec3> points_;
};

}  // namespace kerf::run
