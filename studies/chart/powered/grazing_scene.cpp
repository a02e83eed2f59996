// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "kerf/units.hpp"
#include "studies/chart/powered/round_burr.h"

namespace kerf::chart {

using namespace literals;

PoweredScene grazing_scene() {
    constexpr double radius = 2.0_mm, way = 2.0_mm, apart = 2.0_mm, above = 0.05_mm;
    constexpr double lifting = 1.0_mm_per_s, between = 20.0_mm_per_s;
    constexpr double depths[] = {0.0, 1.0_um, 10.0_um, 50.0_um};
    PoweredScene scene = round_burr_scene(2.0 * radius, 30000.0_rpm, 2.0_mm_per_s);
    scene.id = "grazing";
    scene.title = "Grazing: round burr of 4 mm, 0, 1, 10 and 50 um deep at 2 mm/s, each way once more in its groove";
    scene.bone.surface = [](Vec3 p) { return p.z; };
    scene.bone.tissues = {{"cortical", 1850.0, {}}};
    scene.path = {looking_down({0, 0, above})};
    double volume = 0.0, y = 0.0;
    for (const double depth : depths) {
        // Down at the one end, to the other end, and back on the same line: coplanar with what it has left.
        go_straight(scene.path, {0, y, above}, between);
        go_straight(scene.path, {0, y, -depth}, lifting);
        go_straight(scene.path, {way, y, -depth}, scene.feed);
        go_straight(scene.path, {0, y, -depth}, scene.feed);
        go_straight(scene.path, {0, y, above}, lifting);
        // A slot with half of a cap at either end.
        if (depth > 0.0) volume += groove_volume(radius, depth, way) + groove_volume(radius, depth, 0.0);
        y += apart;
    }
    scene.volume = volume;
    scene.bone.low = {-2.5_mm, -2.5_mm, -1.5_mm};
    scene.bone.high = {way + 2.5_mm, y + 0.5_mm, 0.5_mm};
    return scene;
}

}  // namespace kerf::chart
