// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace kerf {

/// Returns the grade of a screw in a pedicle by how far its thread leaves the bone: A not at all, B under 2 mm, C under
/// 4 mm, D under 6 mm, E more [gertzbein-robbins-1990]. Where the breach lies between `least` and `most` [m] and they
/// differ in grade, both: "B/C".   [any] pure.
[[nodiscard]] std::string gertzbein_robbins(double least, double most);

/// Where a screw leaves the bone.
struct BreachPlaces {
    bool lateral_of_pedicle = false;  ///< or above it
    bool medial_of_pedicle = false;   ///< or below it
    bool of_body = false;             ///< its tip, in front of or beside the body of the vertebra
    bool in_zone = false;             ///< its core is in a zone that the anatomy names, such as the canal
};
/// Returns the grade of a screw in a pedicle by where it leaves the bone: I nowhere, II beside the pedicle and its tip
/// in the body, III its tip out of the body, IV medial of or below the pedicle, V its core in a zone that the anatomy
/// names [heary-2004], the worst of them. V is ours for "endangers the cord, a root or a vessel"; above the pedicle,
/// which the paper does not name, counts as II.   [any] pure.
[[nodiscard]] std::string heary(const BreachPlaces& places);
/// The same where half a voxel decides: "I/IV".
[[nodiscard]] std::string heary(const BreachPlaces& least, const BreachPlaces& most);

}  // namespace kerf
