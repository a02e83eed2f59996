// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "kerf/abi.h"
#include "studies/chart/exact_bone.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::chart {

/// Bone as an array of voxels behind the same questions as Kerf's fields, so that one law can be asked on either.
///
/// A voxel has the tissue at its centre. There is no lag and no gap: what is left is what edges read. Surfaces are not
/// told: `nearest` always says that there is none.
class VoxelBone {
public:
    /// How a point is answered.
    enum class Reading {
        binary,    ///< by the voxel it lies in: whole or gone [tsai-2007]
        density,   ///< by trilinear density, air counting as none [dental-implant-2013, eq. 19, nodes in their right
                   ///< order]
        fraction,  ///< by the shares of the tissues, trilinear [volumetric-drilling, eq. 1, as fractions of volume]
    };

    VoxelBone(const ExactBone& bone, double spacing, Vec3 offset, Reading reading);
    VoxelBone(const VoxelBone&) = delete;
    VoxelBone& operator=(const VoxelBone&) = delete;

    [[nodiscard]] const kerf_bone_query& query() const noexcept { return query_; }
    void place(const Pose& body_from_tool) noexcept { body_from_tool_ = body_from_tool; }

    /// From now on voxels of bone that are asked about lose `loss` [–] of themselves for each point that asks, until
    /// `stop_wearing`.
    void wear(double loss) noexcept { loss_ = loss; }
    void stop_wearing() noexcept { loss_ = 0.0; }
    /// Takes every voxel whose centre is where `is_taken` says (body frame).
    void take(const std::function<bool(Vec3)>& is_taken);

    /// [m³] of voxels that are wholly gone.
    [[nodiscard]] double removed_volume() const noexcept;

private:
    struct Voxel {
        float left = 1.0F;  ///< [–]
        std::int8_t tissue = -1;
    };
    void sample(const kerf_vec3* points, std::uint32_t count, kerf_bone_sample* out) const noexcept;
    [[nodiscard]] Voxel* at(int i, int j, int k) const noexcept;
    void answer_binary(const Voxel* voxel, kerf_bone_sample& out) const noexcept;
    void answer_mixed(Vec3 at, kerf_bone_sample& out) const noexcept;

    double spacing_;
    Vec3 origin_;  ///< low corner of voxel (0, 0, 0)
    int size_[3];
    Reading reading_;
    std::vector<double> densities_;
    mutable std::vector<Voxel> voxels_;  ///< asking wears them
    std::size_t bone_count_ = 0;
    double loss_ = 0.0;
    Pose body_from_tool_ = identity_pose();
    kerf_bone_query query_{};
};

}  // namespace kerf::chart
