// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/field/grid/body.h"
#include "documents/anatomy.h"
#include "text/source.h"

/// Checks the positions of landmarks and zones against the bone.
///
///     E0612  a left and right pair is interchanged
///     E0613  a point is not where its `lies` requires
///     W0614  much of a zone lies in bone
namespace kerf::bone {

/// A position relative to the bone.
struct PointOnBone {
    double distance = 0.0;     ///< [m] to the surface, negative inside; at most `known`
    double known = 0.0;        ///< [m] largest distance in the field
    bool is_in_region = true;  ///< nothing is known beyond the region
};
[[nodiscard]] PointOnBone locate_on_bone(const Body& body, Vec3 at) noexcept;

/// Returns the fraction of a zone's volume in bone [–], by points 1 mm apart, or 200000 of them; 0 for a zone outside
/// the region.   [any] pure.
[[nodiscard]] double fraction_in_bone(const Body& body, const documents::Zone& zone);

/// Checks pairs whose names differ only by the word `left` or `right`, points by their `lies` within their tolerance,
/// and zones, of which at most a quarter should be bone.   [main]
void check_landmarks(const documents::Anatomy& anatomy, const Body& body, text::Diagnostics& diagnostics);

}  // namespace kerf::bone
