// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/field/cut/cut_field.h"

namespace kerf {

/// A bone and its cut.
struct CutBone {
    const Body* bone;
    const CutField* cut;
};

struct Bridge {
    Body bone;
    double span;  ///< [m] the smallest distance that it spans
};

/// Returns the bone that grows between two pieces that face each other. It fills the points outside of both pieces
/// where the sum of the two distances is at most 1.05 times its minimum plus half a voxel. It is in the frame of `a`,
/// consists of its base material, and has its list of materials. Returns nothing if the pieces are farther apart than
/// their fields store, twice four voxels.   [main]
[[nodiscard]] std::optional<Bridge> bridge_between(const CutBone& a, const CutBone& b, const Pose& b_from_a);

}  // namespace kerf
