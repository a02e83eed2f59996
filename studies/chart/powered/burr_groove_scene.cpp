// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include <algorithm>

#include "kerf/units.hpp"
#include "studies/chart/powered/round_burr.h"

namespace kerf::chart {

using namespace literals;

PoweredScene burr_groove_scene() {
    constexpr double radius = 2.0_mm, depth = 1.0_mm, before = 2.2_mm, groove = 3.0_mm, reach = 3.0_mm;
    PoweredScene scene = round_burr_scene(2.0 * radius, 30000.0_rpm, 0.5_mm_per_s);
    scene.id = "burr-groove";
    scene.title = "Groove 1 mm deep, round burr of 4 mm, 0.5 mm/s, 30 000 rpm, entered across an edge";
    scene.bone.surface = [](Vec3 p) { return std::max(p.z, -p.x); };
    scene.bone.tissues = {{"cortical", 1850.0, {}}};
    scene.bone.low = {-1.0_mm, -reach, -depth - 1.5_mm};
    scene.bone.high = {groove + reach, reach, 1.0_mm};
    scene.path = {looking_down({-before, 0, -depth})};
    go_straight(scene.path, {groove, 0, -depth}, scene.feed);
    scene.volume = groove_volume(radius, depth, groove);
    return scene;
}

}  // namespace kerf::chart
