// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include <algorithm>
#include <cmath>

#include "kerf/units.hpp"
#include "studies/chart/drill/scene.h"

namespace kerf::chart {

using namespace literals;

Scene femur_scene() {
    constexpr double outer = 13.0_mm, inner = 5.3_mm;
    Scene scene;
    scene.id = "femur";
    scene.title = "Femur's shaft, both cortices, 4.5 mm drill";
    scene.drill.diameter = 4.5_mm;
    scene.drill.point_angle = 118.0_deg;
    // The shaft runs along x; its nearest point to the drill is the origin.
    scene.bone.surface = [](Vec3 p) {
        const double rho = std::hypot(p.y, p.z + outer);
        return std::max(rho - outer, inner - rho);
    };
    scene.bone.tissues = {{"cortical", 1850.0, {}}};
    const double reach = scene.drill.radius() + 1.0_mm;
    scene.bone.low = {-reach, -reach, -2.0 * outer - 1.0_mm};
    scene.bone.high = {reach, reach, 1.0_mm};
    scene.depth = {-1.0_mm};
    go_to(scene, 2.0 * outer + scene.drill.point_depth() + 0.5_mm, scene.feed);
    return scene;
}

}  // namespace kerf::chart
