// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "core/field/pieces/present_bone.h"
#include "documents/measure_plan.h"
#include "run/scene.h"
#include "text/source.h"

/// Evaluates the measures of a procedure on the bone of a run: on body 0, the part that remains.
namespace kerf::run {

/// Measures the present bone, in the order of the procedure's measures.   [worker]
/// @param world_from_body   for each body; empty: no body has moved
[[nodiscard]] std::vector<documents::MeasureReading> measure_bone(const Scene& scene, const PresentBone& bone,
                                                                  std::span<const Pose> world_from_body);

/// Measures the bone before the first cut. Refuses a measure that has no value on it (E0529).   [main]
void measure_before_cuts(Scene& scene, text::Diagnostics& diagnostics);

}  // namespace kerf::run
