// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/haptics/scene/bone_scene.h"
#include "run/scene.h"

namespace kerf {

/// Returns what belongs to the bone of a scene: zones of its anatomy and axes of its steps. At first all belongs to
/// body 0. Where that comes apart, each belongs to the nearest of the parts from then on, and moves with it; of equally
/// near ones to the first. A zone's distance is that of its solids to the part's surface, an axis's that of its entry,
/// both to what every second sample shows of the surface. The scene must outlive it.   [main]
[[nodiscard]] Belongings belongings_of(const Scene& scene);

}  // namespace kerf
