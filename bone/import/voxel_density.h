// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bone/image/voxel_image.h"
#include "documents/anatomy.h"

namespace kerf::bone {

/// Returns densities [kg/m³]. Voxels deeper in bone than `cortex` [m] use their own values and `line`. All others take
/// over these densities, so that brighter or darker neighbours do not mix in. Nothing if no voxel is that deep. `notes`
/// receives a description.   [main]
[[nodiscard]] std::optional<VoxelImage> densities_in_voxels(const VoxelImage& scan, const VoxelImage& distance,
                                                            double cortex, const documents::DensityLine& line,
                                                            std::vector<std::string>& notes);

}  // namespace kerf::bone
