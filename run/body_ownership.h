// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/haptics/scene/bone_scene.h"
#include "run/scene.h"

namespace kerf::run {

/// Returns the owners of a scene's zones and step axes, and the rule by which they follow the bone. At first body 0
/// owns all. If it splits, each zone and axis belongs to the nearest part and moves with it; of equally near parts, to
/// the first. Distances are from a zone's solids or an axis's entry to every second sample of a part's surface.
/// Pre: the scene outlives the result.   [main]
[[nodiscard]] BodyOwnership body_ownership_of(const Scene& scene);

}  // namespace kerf::run
