// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/import/bone_mask.h"

namespace kerf {

/// Distances to the border of bone, on the grid of its scan.
struct VoxelDistance {
    VoxelImage distance;          ///< [m] to the border, negative in bone; grows as fast as the way to it
    double crossing_share = 0.0;  ///< [–] of the faces between bone and air: where the values cross the threshold
};

/// Between an inner voxel a and an outer voxel b the border lies at
///
///     t = (v_a − threshold) / (v_a − v_b)   of the way, ½ where the values do not cross
///
/// and the distance follows from |∇d| = 1 (fast sweeping), up to `farthest` [m]; beyond it is that. Pre: the image is not
/// sheared.   [main]
[[nodiscard]] VoxelDistance distance_in_voxels(const BoneMask& mask, double threshold, double farthest);

}  // namespace kerf
