// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include <vector>

#include "kerf/units.hpp"
#include "studies/chart/drill/scene.h"

namespace kerf::chart {

using namespace literals;

std::vector<Scene> all_scenes() {
    return {slab_scene(0.0),    slab_scene(10.0_deg), slab_scene(30.0_deg),         femur_scene(),
            trochanter_scene(), pedicle_scene(0.0),   pedicle_scene(medial_breach), fast_scene()};
}

}  // namespace kerf::chart
