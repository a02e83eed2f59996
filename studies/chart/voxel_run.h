// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "studies/chart/method.h"
#include "studies/chart/voxel_bone.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::chart {

/// A plugin's law on voxels, evaluated at the rate of a prescribed motion (`coupling: direct`).
class VoxelRun : public Run {
public:
    /// When bone goes.
    enum class Removal {
        when_finished,  ///< all that the tool swept, by voxels' centres [tsai-2007]
        where_asked,    ///< voxels wear where the law's `commit` asks [volumetric-drilling, dental-implant-2013]
    };
    /// @param gain  on all of its force [–]
    VoxelRun(const Scene& scene, ToolSetup setup, const Fineness& fineness, VoxelBone::Reading reading, Removal removal,
             double gain);

    Felt tick(const Pose& next) override;
    void command_spindle(double revolutions_per_second) override { setup_.drives[0] = revolutions_per_second; }
    double removed_volume() override;

private:
    Scene scene_;
    ToolSetup setup_;
    VoxelBone bone_;
    Removal removal_;
    double gain_, loss_;
    Pose pose_;
    double deepest_;
    std::vector<std::max_align_t> state_;
    double signals_[KERF_MAX_SIGNALS]{};
};

}  // namespace kerf::chart
