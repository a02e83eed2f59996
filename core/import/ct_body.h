// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>

#include "core/import/import_report.h"
#include "core/import/image/read_image.h"
#include "core/procedure/anatomy.h"
#include "core/procedure/solids.h"

/// Bone out of a CT: which voxels, where the border between them runs, how dense it is.
///
///     E0630  the label map does not lie on the image's grid
///     E0631  the axes lie outside the image
///     E0632  the image is sheared (tilted gantry)
///     E0633  no voxel is bone
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

/// Reads the files that `anatomy.ct` names and makes the bone.
///
/// Mask: the labels to keep, or whatever reaches the threshold, its largest piece; closed and filled as told. Border:
/// voxels beside the mask's border that the grey values put on its other side change sides (one voxel, never into
/// another label); then between an inner voxel a and an outer voxel b at
///
///     t = (v_a − threshold) / (v_a − v_b)   of the way, ½ where the values do not cross
///
/// and the distance follows from |∇d| = 1 (fast sweeping).
/// Error: E062x, E063x.   Pre: `anatomy.ct`.   [main]
[[nodiscard]] std::optional<CtBone> make_ct_bone(const Anatomy& anatomy, Diagnostics& diagnostics);

/// The same for images that are in memory. `labels` may be null.   [main]
[[nodiscard]] std::optional<CtBone> make_ct_bone(const Anatomy& anatomy, const VoxelImage& image,
                                                 const VoxelImage* labels, Diagnostics& diagnostics);

}  // namespace kerf
