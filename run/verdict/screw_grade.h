// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace kerf::run {

/// Returns the grade of a pedicle screw by the breach of its thread: A none, B under 2 mm, C under 4 mm, D under 6 mm,
/// E more [gertzbein-robbins-1990]. For a breach between `least` and `most` [m] with different grades, returns both:
/// "B/C".   [any] pure.
[[nodiscard]] std::string gertzbein_robbins(double least, double most);

/// The parts of a vertebra in which a screw leaves the bone.
struct BreachLocations {
    bool lateral_of_pedicle = false;  ///< or cranial of it
    bool medial_of_pedicle = false;   ///< or caudal of it
    bool of_body = false;             ///< its tip is out of the vertebral body, in front or at the side
    bool in_zone = false;             ///< its core is in a zone of the anatomy, such as the canal
};
/// Returns the grade of a pedicle screw by the location of its breach, the worst that applies [heary-2004]. I: none.
/// II: lateral of the pedicle, with the tip in the body. III: the tip is out of the body. IV: medial of or below the
/// pedicle. V: the core is in a zone of the anatomy. V is our reading of "endangers the cord, a root or a vessel". A
/// breach above the pedicle, which the paper does not name, counts as II.   [any] pure.
[[nodiscard]] std::string heary(const BreachLocations& places);
/// Returns both grades where half a voxel decides: "I/IV".
[[nodiscard]] std::string heary(const BreachLocations& least, const BreachLocations& most);

}  // namespace kerf::run
