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

/// Bone out of a CT: which voxels, where the border between them runs, how dense it is.
///
///     E0630  the label map covers nothing of the region
///     E0631  the axes lie outside the image
///     E0632  the image is sheared within its slices
///     E0633  no voxel is bone
///     E0634  no bone near the landmark that names the piece
///     E0619  a link leads out of the document's folder
///     E0635  the segmentation has no structure of that name
///     E0636  several structures of that name or number, or with the same voxels
///     W0675  values that are no HU, or metal
namespace kerf {

/// A bone on the grid of its CT, cut out around the planned axes.
struct CtBone {
    VoxelImage distance;  ///< [m] to the border, negative in bone; grows as fast as the way to it
    Box region{};         ///< [m] LPS: around the axes, as far as the image goes; what lies outside was not looked at
    double mean_value = 0.0;  ///< [HU or grey] of the voxels deeper in bone than the cortex, or else the threshold
    /// [kg/m³] of the base tissue, if `ct.density` says how: by their own values in the voxels deeper in bone than the
    /// cortex, from there extended to all others, so that nothing brighter or darker beside the tissue is mixed in.
    std::optional<VoxelImage> density;
    std::size_t voxels = 0;  ///< that are bone, in the region
    ImportReport report;     ///< what was done, and with which files
};

/// Reads the files that `anatomy.ct` names, and of them only the region, and makes the bone.
///
/// Mask: the labels to keep, or whatever reaches the threshold, of it the largest piece or the one at a landmark;
/// closed and filled as told. Border: voxels beside the mask's border that the grey values put on its other side change
/// sides (one voxel, never into another label); then as `distance_in_voxels` says. A label map on another grid gives
/// each voxel its nearest label. Error: E062x, E063x, E066x, E067x.   Pre: `anatomy.ct`.   [main]
[[nodiscard]] std::optional<CtBone> make_ct_bone(const Anatomy& anatomy, Diagnostics& diagnostics,
                                                 const ImportOptions& options = {});

/// The same for images that are in memory. `labels` may be null.   [main]
[[nodiscard]] std::optional<CtBone> make_ct_bone(const Anatomy& anatomy, const VoxelImage& image,
                                                 const VoxelImage* labels, Diagnostics& diagnostics,
                                                 const ImportOptions& options = {});

}  // namespace kerf
