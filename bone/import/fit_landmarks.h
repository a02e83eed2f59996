// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "bone/import/surface_rays.h"
#include "bone/report/import_report.h"
#include "documents/anatomy.h"
#include "text/source.h"

/// Landmarks that are found from the bone.
///
///     E0615  too little of the bone has the shape that is fitted, in about the size that is written
///     E0616  the residual is too large
///     E0617  what is found lies too far from what is written
///     E0618  the axis along which condyles are seen is not there
namespace kerf {

/// Whether any landmark has a `fit:`.
[[nodiscard]] bool has_fits(const Anatomy& anatomy) noexcept;

/// Returns the box in which fits look for the bone, LPS [m]; empty (`low` not below `high`) if there are none.
[[nodiscard]] Box region_of_fits(const Anatomy& anatomy) noexcept;

/// Replaces the positions of all landmarks that have a `fit:` by what is found from `bone`, and removes their `fit`:
/// nothing behind this sees whether a landmark was written or fitted. Points come first, then axes, and condyles last:
/// each refers only to what is known by then. Adds a note for each fit to `report`, and the landmarks themselves.
/// False, with one error for each fit that is refused: then those landmarks stay as written.   [main]
[[nodiscard]] bool fit_landmarks(Anatomy& anatomy, const BoneShape& bone, ImportReport& report,
                                 Diagnostics& diagnostics);

/// Replaces the landmarks of `anatomy` by those of the same name that import fitted.
void use_fits(Anatomy& anatomy, const ImportReport& report);

}  // namespace kerf
