// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bone/image/segments.h"
#include "bone/import/bone_mask.h"
#include "documents/anatomy.h"

/// The labels that select the bone of a CT.
namespace kerf::bone {

/// A label map, opened but not read, from any source.
struct LabelMap {
    VoxelGrid grid;
    std::vector<Segment> segments;  ///< structures that the file names
    /// Reads a part of one layer; nothing if it cannot be read, which is reported by then.
    std::function<std::optional<VoxelImage>(const VoxelRange&, int layer)> read;
};

/// Marks the kept labels as bone, and the voxels of other labels as other structures. Each voxel of the scan takes the
/// label whose voxel is nearest. Returns false if a layer cannot be read.
///
/// Throws ImportError: E0630, the map covers nothing of the scan; E0635, E0636, a structure that is unknown or
/// ambiguous; E0637, values that are no labels.   [main]
[[nodiscard]] bool mark_labels(BoneMask& mask, const documents::CtSource& ct, const LabelMap& labels);

}  // namespace kerf::bone
