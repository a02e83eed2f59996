// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "bone/image/image_file.h"
#include "bone/image/voxel_image.h"
#include "text/source.h"

namespace kerf {

/// Reads NIfTI-1 (.nii, .nii.gz), NRRD (.nrrd, .nhdr) or MetaImage (.mha, .mhd): three dimensions, one number per
/// voxel. The file is checked by `check_image_file()` first, so that a small file that lies costs no memory. Error
/// (E062x, codes in bone/image/image_file.h): nothing is left half-read. Never throws.   [main]
[[nodiscard]] std::optional<VoxelImage> read_image(const std::string& file, Diagnostics& diagnostics);

/// The same of a file whose header is known, and of it only some voxels of one layer. Pre: the range lies in the image.
/// [main]
[[nodiscard]] std::optional<VoxelImage> read_image(const std::string& file, const ImageFile& header,
                                                   const VoxelRange& range, int layer, Diagnostics& diagnostics);

}  // namespace kerf
