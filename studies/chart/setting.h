// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/haptics/law/tool.h"
#include "studies/chart/exact_bone.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::chart {

inline constexpr double dt = 1e-3;  ///< [s] a tick

/// What a run takes of a scene, whatever its tool.
struct Setting {
    ExactBone bone{};
    ToolSetup setup{};
    Pose start = identity_pose();  ///< of the tool
    double feed = 0.0;             ///< [m/s] along the tool: the force scale of a device is set for it
    double working_force = 0.0;    ///< [N] in hands, the force scale set as a procedure's; 0: clamped, set for the feed
};

}  // namespace kerf::chart
