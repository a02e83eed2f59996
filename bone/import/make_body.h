// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "bone/report/import_report.h"
#include "core/field/grid/body.h"
#include "documents/anatomy.h"

namespace kerf {

/// The body an anatomy describes, sampled at `spacing` [m]. `report`, if given, gets what was done and decided on the
/// way; `options.progress`, if given, is told often how far it is. Error (E06xx): no bone at all, a grid too large, a
/// shell thinner than can be carried.   [main]
[[nodiscard]] std::optional<Body> make_body(const Anatomy& anatomy, double spacing, Diagnostics& diagnostics,
                                            ImportReport* report = nullptr, const ImportOptions& options = {});

/// Where an axis meets bone.
struct AxisInBone {
    double entry = 0.0;  ///< [m] from the axis's origin to the first bone; < 0: none
    double share = 0.0;  ///< [–] of the axis from the entry to its end that lies in bone
};
[[nodiscard]] AxisInBone axis_in_bone(const Body& body, const LandmarkAxis& axis);

/// Returns the unit vector straight into the uncut bone's surface, averaged over 1.2 mm around a point on it; zero
/// where it finds none.
[[nodiscard]] Vec3 into_surface(const Body& body, Vec3 point);

/// Refuses an axis that meets no bone, or lies in bone for less than 80 % behind its entry (E0610, E0611).   [main]
void check_axis(const Anatomy& anatomy, const LandmarkAxis& axis, const AxisInBone& found, Diagnostics& diagnostics);

}  // namespace kerf
