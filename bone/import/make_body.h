// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bone/report/import_report.h"
#include "core/field/grid/body.h"
#include "documents/anatomy.h"
#include "text/result.h"

namespace kerf::bone {

/// Returns the body of an anatomy, sampled at `spacing` [m]. `report`, if given, receives operations and decisions.
/// `options.progress`, if given, is called often with the progress. Error (E06xx): no bone, a grid too large, a shell
/// too thin for the spacing.   [main]
[[nodiscard]] text::Result<Body> make_body(const documents::Anatomy& anatomy, double spacing,
                                           ImportReport* report = nullptr, const ImportOptions& options = {});

/// Intersection of an axis with bone.
struct AxisInBone {
    double entry = 0.0;  ///< [m] from the axis's origin to the first bone; < 0: none
    double share = 0.0;  ///< [–] fraction of the axis in bone, from the entry to its end
    /// [m] along the axis, from the surface of the bone to the axis's origin; 0: it begins outside.
    double inside = 0.0;
    bool is_reversed = false;  ///< it begins deep in the bone and leads out of it
    /// Returns whether depths along the axis do not count from the surface.
    [[nodiscard]] bool begins_inside() const noexcept { return inside > 1e-3; }
};
[[nodiscard]] AxisInBone axis_in_bone(const Body& body, const documents::LandmarkAxis& axis);

/// Returns the unit vector into the uncut bone, perpendicular to its surface, averaged over 1.2 mm around a point on
/// it; zero without a surface.
[[nodiscard]] Vec3 into_surface(const Body& body, Vec3 point);

/// Refuses an axis that meets no bone, that begins more than 1 mm inside it, whose ends are exchanged, or that has less
/// than 80 % in bone behind its entry (E0610, E0607, E0611).   [main]
void check_axis(const documents::Anatomy& anatomy, const documents::LandmarkAxis& axis, const AxisInBone& found,
                text::Diagnostics& diagnostics);

}  // namespace kerf::bone
