// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "app/scene.h"
#include "core/field/present_bone.h"

namespace kerf {

/// What there was at first, body 0, and what came off it and is adopted: not what was put in or grew.   [main]
[[nodiscard]] std::vector<std::size_t> parts_of_the_bone(const PresentBone& bone);

/// Zones and axes that belonged to the body `from`, of which several `bodies` have become, belong to the nearest of
/// these from now on, and move with it; of equally near ones to the first. A zone's distance is that of its solids to
/// the part's surface, an axis's that of where it meets bone, both to what every second sample shows of it. Nothing has
/// moved yet.   [main]
void pass_on(Owners& owners, std::size_t from, const std::vector<std::size_t>& bodies, const Scene& scene,
             const PresentBone& bone);

}  // namespace kerf
