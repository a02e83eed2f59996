// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/field/grid/body.h"
#include "documents/anatomy.h"
#include "text/source.h"

/// Whether landmarks and zones can be where the anatomy says.
///
///     E0612  a pair called left and right lies the other way round
///     E0613  a point does not lie as `lies` says
///     W0614  much of a zone lies in bone
namespace kerf {

/// How a place lies to the bone.
struct PlaceOnBone {
    double distance = 0.0;     ///< [m] to the surface, negative inside; no farther than `known`
    double known = 0.0;        ///< [m] how far a field knows distances
    bool is_in_region = true;  ///< beyond it nobody looked
};
[[nodiscard]] PlaceOnBone place_on_bone(const Body& body, Vec3 at) noexcept;

/// Share of a zone's volume that lies in bone [–], by points 1 mm apart, or 200000 of them; 0 for a zone outside the
/// region.   [any] pure.
[[nodiscard]] double share_in_bone(const Body& body, const Zone& zone);

/// Pairs whose names differ only by the word `left` or `right`; and points by their `lies`, within their tolerance; and
/// zones, of which no more than a quarter should be bone.   [main]
void check_landmarks(const Anatomy& anatomy, const Body& body, Diagnostics& diagnostics);

}  // namespace kerf
