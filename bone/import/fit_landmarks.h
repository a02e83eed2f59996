// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "bone/import/surface_rays.h"
#include "bone/report/import_report.h"
#include "documents/anatomy.h"
#include "text/source.h"

/// Fits landmarks to the bone.
///
///     E0615  too little of the bone has the fitted shape at about the given size
///     E0616  the residual is too large
///     E0617  the fit is too far from the guess
///     E0618  the axis of view of condyles is missing
namespace kerf::bone {

/// Returns whether any landmark has a `fit:`.
[[nodiscard]] bool has_fits(const documents::Anatomy& anatomy) noexcept;

/// Returns the search region of all fits, LPS [m]; empty (`low` not below `high`) without fits.
[[nodiscard]] Box region_of_fits(const documents::Anatomy& anatomy) noexcept;

/// Replaces the positions of all landmarks with a `fit:` by positions fitted to `bone`, and removes their `fit`. Later
/// code cannot distinguish fitted and written landmarks. The order is points, axes, condyles, because each refers to
/// earlier ones. Adds a note for each fit and the fitted landmarks to `report`. Returns false, with one error for each
/// refused fit; these landmarks stay as written.   [main]
[[nodiscard]] bool fit_landmarks(documents::Anatomy& anatomy, const BoneShape& bone, ImportReport& report,
                                 text::Diagnostics& diagnostics);

/// Replaces landmarks of `anatomy` by the fitted ones with the same name.
void use_fits(documents::Anatomy& anatomy, const ImportReport& report);

}  // namespace kerf::bone
