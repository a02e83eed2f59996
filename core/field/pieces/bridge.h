// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/field/cut/cut_field.h"

namespace kerf {

/// A bone and what has been cut of it.
struct CutBone {
    const Body* bone;
    const CutField* cut;
};

struct Bridge {
    Body bone;
    double span;  ///< [m] the least distance it spans
};

/// What grows between two pieces that face each other: all that lies outside of both where their distances together are
/// no more than 1.05 times the least there is, and half a voxel. In the frame of `a`, of its base material, with the
/// list of its materials. Nothing where they are farther from each other than both fields know, twice four voxels.
/// [main]
[[nodiscard]] std::optional<Bridge> bridge_between(const CutBone& a, const CutBone& b, const Pose& b_from_a);

}  // namespace kerf
