// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "bone/import/bone_mask.h"
#include "bone/import/label_map.h"
#include "documents/anatomy.h"
#include "text/result.h"

/// Compares labels with the scan that they select from.
namespace kerf::bone {

/// How well labels fit a scan: at the border of bone, the scan is brighter inside than outside. In a lumbar CT with
/// voxels of 1.5 mm the fraction is 0.90 for its own labels, 0.70 to 0.81 after a shift by one voxel, 0.57 to 0.64
/// after one by two voxels, and 0.49 to 0.62 for mirrored labels.
struct LabelFit {
    std::size_t faces = 0;         ///< voxel faces between bone and no label that were compared
    double brighter_inside = 1.0;  ///< [–] fraction of them
};

/// Returns the fit of a mask if it was moved by `shift` voxels. Compares the mean of `reach` voxels on each side of a
/// face, so a cortex one voxel thick counts.   [main]
[[nodiscard]] LabelFit label_fit(const BoneMask& mask, int reach, std::array<int, 3> shift = {});

/// Adds a note about the fit of the labels. Warns (W0678) of labels that fit badly, or better one or two voxels away,
/// and of a label map that ends within bone. Throws ImportError (E0630) if labels that fit badly lie in air, or fit
/// well when mirrored or moved: then they belong to another frame. Pre: `mask` as `mark_labels` made it.   [main]
void check_label_fit(const BoneMask& mask, const documents::Anatomy& anatomy, const LabelMap& labels,
                     std::vector<std::string>& notes, text::Diagnostics& diagnostics);

}  // namespace kerf::bone
