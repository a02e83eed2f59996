// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "bone/image/image_file.h"
#include "bone/image/voxel_image.h"
#include "text/result.h"

namespace kerf::bone {

/// Reads NIfTI-1 (.nii, .nii.gz), NRRD (.nrrd, .nhdr) or MetaImage (.mha, .mhd): three dimensions, one number per
/// voxel. `check_image_file()` checks the file first, so a false header costs no memory. Error (E062x, codes in
/// bone/image/image_file.h): returns nothing. Never throws.   [main]
[[nodiscard]] text::Result<VoxelImage> read_image(const std::string& file);

/// Reads a range of voxels of one layer from a file whose header is checked. Pre: the range lies in the image.   [main]
[[nodiscard]] text::Result<VoxelImage> read_image(const std::string& file, const ImageFile& header,
                                                  const VoxelRange& range, int layer);

}  // namespace kerf::bone
