// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include <algorithm>
#include <cmath>

#include "kerf/units.hpp"
#include "studies/chart/drill/scene.h"

namespace kerf::chart {

using namespace literals;

Scene fast_scene() {
    constexpr double slab = 6.0_mm, sheet_above = 10.0_mm, sheet_below = 10.5_mm;
    Scene scene;
    scene.id = "fast";
    scene.title = "Fast motion: pecks at 0.1 m/s, up to 1 m/s in the hole, then 1 m/s through 0.5 mm of bone";
    scene.drill.diameter = 5.4_mm;
    scene.drill.point_angle = 118.0_deg;
    scene.spindle = 3000.0_rpm;
    scene.feed = 100.0_mm_per_s;
    scene.bone.surface = [](Vec3 p) {
        return std::min(std::abs(p.z + 0.5 * slab) - 0.5 * slab,
                        std::abs(p.z + 0.5 * (sheet_above + sheet_below)) - 0.5 * (sheet_below - sheet_above));
    };
    scene.bone.tissues = {{"cortical", 1850.0, {}}};
    const double reach = scene.drill.radius() + 1.0_mm, last = sheet_below + scene.drill.point_depth() + 1.0_mm;
    scene.bone.low = {-reach, -reach, -sheet_below - 1.0_mm};
    scene.bone.high = {reach, reach, 1.0_mm};
    constexpr double one_metre_per_second = 1000.0_mm_per_s;
    scene.depth = {-1.0_mm};
    go_to(scene, 4.0_mm, scene.feed);
    go_to(scene, -0.5_mm, one_metre_per_second);
    go_to(scene, 3.8_mm, 500.0_mm_per_s);
    go_to(scene, 5.0_mm, scene.feed);
    go_to(scene, -0.5_mm, one_metre_per_second);
    go_to(scene, 4.9_mm, one_metre_per_second);
    go_to(scene, slab + scene.drill.point_depth() + 0.5_mm, scene.feed);
    go_to(scene, last, one_metre_per_second);
    return scene;
}

}  // namespace kerf::chart
