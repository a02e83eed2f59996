// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "bone/report/import_report.h"
#include "core/field/grid/body.h"
#include "documents/anatomy.h"
#include "text/source.h"

namespace kerf {

/// Takes the fragment of the anatomy's fracture out of the whole bone. Returns it, where it is in the whole bone;
/// `bone` keeps the rest. The tissues of both are those of the whole bone, so the fracture shows no new cortex. Error:
/// E0605, a side of the fracture has no bone; `bone` is the whole one then.   [main]
[[nodiscard]] std::optional<Body> break_bone(Body& bone, const Anatomy& anatomy, ImportReport& report,
                                             Diagnostics& diagnostics);

}  // namespace kerf
