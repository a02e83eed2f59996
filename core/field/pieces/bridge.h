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
    double span;  ///< [m] smallest sum of the distances of a point to both pieces
};

/// Returns bone that fills the gap between two pieces. It contains a point outside both pieces if the sum of its
/// distances to them is at most 1.05 times the minimum plus half a voxel. It is in the frame of `a`, lists the
/// materials of `a`, and consists of the last one, the base. Returns nothing if no point outside both is nearer than
/// four voxels to each.   [main]
[[nodiscard]] std::optional<Bridge> bridge_between(const CutBone& a, const CutBone& b, const Pose& b_from_a);

}  // namespace kerf
