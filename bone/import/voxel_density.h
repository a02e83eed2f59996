// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bone/image/voxel_image.h"
#include "documents/anatomy.h"
#include "text/source.h"

namespace kerf::bone {

/// Returns densities [kg/m³]. Voxels deeper in bone than `cortex` [m] use their own values and the line of
/// `ct.density`, within its floor and 3 g/cm³, the range of a written density. All others take over these densities, so
/// that brighter or darker neighbours do not mix in. Nothing if no voxel is that deep. `notes` receives a description,
/// `diagnostics` W0675 for densities that bone does not have.   [main]
[[nodiscard]] std::optional<VoxelImage> densities_in_voxels(const VoxelImage& scan, const VoxelImage& distance,
                                                            double cortex, const documents::Anatomy& anatomy,
                                                            std::vector<std::string>& notes,
                                                            text::Diagnostics& diagnostics);

}  // namespace kerf::bone
