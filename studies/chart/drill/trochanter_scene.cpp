// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include <algorithm>
#include <cmath>

#include "kerf/units.hpp"
#include "studies/chart/drill/scene.h"

namespace kerf::chart {

using namespace literals;

namespace {

/// Exact distance to all points within `radius` of a line from `a` to `b`.
double capsule(Vec3 p, Vec3 a, Vec3 b, double radius) {
    const Vec3 along = b - a;
    const double share = std::clamp(dot(p - a, along) / dot(along, along), 0.0, 1.0);
    return length(p - a - share * along) - radius;
}

}  // namespace

Scene trochanter_scene() {
    constexpr double cortex = 1.5_mm, shaft_radius = 13.0_mm, neck_radius = 15.0_mm, head_radius = 23.0_mm;
    constexpr double neck_shaft = 125.0_deg, offset = 43.0_mm;
    Scene scene;
    scene.id = "trochanter";
    scene.title = "Trochanter along the neck, 1.5 mm of cortex over cancellous bone, 5.4 mm drill";
    scene.drill.diameter = 5.4_mm;
    scene.drill.point_angle = 118.0_deg;
    scene.is_oblique = true;
    // The neck lies along the drill's way, -z; the shaft's axis crosses it where the drill has passed half of the
    // shaft.
    const Vec3 down_the_shaft{std::sin(neck_shaft), 0.0, -std::cos(neck_shaft)};
    const Vec3 crossing{0, 0, -shaft_radius / std::sin(neck_shaft)};
    const Vec3 head = crossing - (offset / std::sin(neck_shaft)) * Vec3{0, 0, 1};
    const Vec3 top = crossing - 15.0_mm * down_the_shaft, bottom = crossing + 80.0_mm * down_the_shaft;
    scene.bone.surface = [=](Vec3 p) {
        return std::min({capsule(p, top, bottom, shaft_radius), capsule(p, crossing, head, neck_radius),
                         length(p - head) - head_radius});
    };
    // 353 mg/cm3: apparent density of the femoral head, Haba and others 2012.
    scene.bone.tissues = {{"cancellous", 353.0, [surface = scene.bone.surface](Vec3 p) { return surface(p) + cortex; }},
                          {"cortical", 1850.0, {}}};
    const double last = 20.0_mm, reach = scene.drill.radius() + 1.0_mm;
    scene.bone.low = {-reach, -reach, -last - 1.0_mm};
    scene.bone.high = {reach, reach, 4.0_mm};
    scene.depth = {-3.0_mm};
    go_to(scene, last, scene.feed);
    return scene;
}

}  // namespace kerf::chart
