// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bone/image/scan.h"
#include "bone/report/import_report.h"
#include "core/field/grid/box.h"
#include "documents/anatomy.h"
#include "text/result.h"

/// Makes bone from a CT: selects voxels, finds the border between them, computes densities.
///
///     E0630  the label map covers nothing of the region, or does not fit the scan
///     E0631  the axes lie outside the image
///     E0632  the image is sheared within its slices
///     E0633  no voxel is bone
///     E0634  no bone near the landmark that names the piece
///     E0619  a link leads out of the document's folder
///     E0635  the segmentation has no structure of that name
///     E0636  several structures of that name or number, or with the same voxels
///     E0637  values of the label map that are no labels
///     W0675  values that are not HU, or metal
///     W0678  labels that hardly fit the scan, or end within bone
///     W0679  stray pieces of the kept labels
namespace kerf::bone {

/// A bone on the grid of its CT, cropped around the planned axes.
struct CtBone {
    VoxelImage distance;      ///< [m] to the border, negative in bone; its gradient has length 1
    Box region{};             ///< [m] LPS: around the axes, clipped to the image; data outside are not read
    double mean_value = 0.0;  ///< [HU or grey] of the voxels below the cortex; without any, the threshold
    /// [kg/m³] of the base tissue, if `ct.density` defines it. Voxels below the cortex use their own values. All others
    /// take over these densities, so that brighter or darker neighbours do not mix in.
    std::optional<VoxelImage> density;
    std::size_t voxels = 0;  ///< bone voxels in the region
    ImportReport report;     ///< operations and hashes of the files
};

/// Reads the region from the files of `anatomy.ct`, and makes the bone.
///
/// Mask: the kept labels, or all voxels above the threshold; of these the largest piece or the one at a landmark;
/// closed and filled as configured. Border: a voxel next to the mask's border changes sides if its grey value is on the
/// other side of the threshold (one voxel, never into another label). Then `distance_in_voxels` finds the border. A
/// label map on another grid gives each voxel its nearest label. Error: E062x, E063x, E066x, E067x. Pre: `anatomy.ct`.
/// [main]
[[nodiscard]] text::Result<CtBone> make_ct_bone(const documents::Anatomy& anatomy, const ImportOptions& options = {});

/// Makes the bone from images in memory. `labels` may be null.   [main]
[[nodiscard]] text::Result<CtBone> make_ct_bone(const documents::Anatomy& anatomy, const VoxelImage& image,
                                                const VoxelImage* labels, const ImportOptions& options = {});

}  // namespace kerf::bone
