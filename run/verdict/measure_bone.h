// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "core/field/pieces/present_bone.h"
#include "documents/measure_plan.h"
#include "run/scene.h"
#include "text/source.h"

/// The measures of a procedure on the bone of a run: on body 0, which is what stays.
namespace kerf {

/// Measures what is left of the bone, each measure in the order of the procedure.   [worker]
/// @param world_from_body   of each body; empty: nothing has moved
[[nodiscard]] std::vector<MeasureReading> measure_bone(const Scene& scene, const PresentBone& bone,
                                                       std::span<const Pose> world_from_body);

/// Measures the bone before the first cut. Refuses a measure that cannot be made of it (E0529).   [main]
void measure_before_cuts(Scene& scene, Diagnostics& diagnostics);

}  // namespace kerf
