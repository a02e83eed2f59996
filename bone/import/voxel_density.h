// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bone/image/voxel_image.h"
#include "documents/anatomy.h"

namespace kerf {

/// Densities [kg/m³] of the voxels that are deeper in bone than `cortex` [m], by their own values and a line; extended
/// from there to all others, so that nothing brighter or darker beside the tissue is mixed in. None if no voxel is that
/// deep. What was done goes into `notes`.   [main]
[[nodiscard]] std::optional<VoxelImage> densities_in_voxels(const VoxelImage& scan, const VoxelImage& distance,
                                                            double cortex, const DensityLine& line,
                                                            std::vector<std::string>& notes);

}  // namespace kerf
