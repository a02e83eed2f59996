// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "studies/chart/run.h"
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
    /// What the tool swept on its way through some poses: whether a point (body frame) lies in it.
    using Swept = std::function<std::function<bool(Vec3)>(const std::vector<Pose>& visited)>;
    /// @param gain   on all of its force [–]
    /// @param swept  unused where bone goes where the law asks
    VoxelRun(Setting setting, const Fineness& fineness, VoxelBone::Reading reading, Removal removal, double gain,
             Swept swept);

    Felt tick(const Pose& next) override;
    void command_spindle(double revolutions_per_second) override { setting_.setup.drives[0] = revolutions_per_second; }
    double removed_volume() override;

private:
    Setting setting_;
    VoxelBone bone_;
    Removal removal_;
    double gain_, loss_;
    Swept swept_;
    std::vector<Pose> visited_;
    std::vector<std::max_align_t> state_;
    double signals_[KERF_MAX_SIGNALS]{};
};

}  // namespace kerf::chart
