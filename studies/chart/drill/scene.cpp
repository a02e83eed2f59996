// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/drill/scene.h"

#include <cmath>

#include "kerf/units.hpp"

namespace kerf::chart {

using namespace literals;

void go_to(Scene& scene, double to, double speed) {
    const double from = scene.depth.back(), step = speed * dt;
    const int whole = static_cast<int>(std::abs(to - from) / step - 1e-9);
    const double way = to > from ? step : -step;
    for (int i = 1; i <= whole; ++i) scene.depth.push_back(from + i * way);
    scene.depth.push_back(to);
}

Scene slab_scene(double tilt) {
    constexpr double first = 4.0_mm, second = 14.0_mm, third = 18.0_mm;
    Scene scene;
    const int degrees = static_cast<int>(std::lround(tilt / 1.0_deg));
    scene.id = "slab-" + std::to_string(degrees);
    scene.title = "Layered slab, 4 + 10 + 4 mm, drill tilted by " + std::to_string(degrees) + " deg";
    scene.drill.diameter = 5.4_mm;
    scene.drill.point_angle = 118.0_deg;
    scene.along = {std::sin(tilt), 0.0, -std::cos(tilt)};
    scene.is_oblique = tilt != 0.0;
    scene.bone.surface = [](Vec3 p) { return std::abs(p.z + 0.5 * third) - 0.5 * third; };
    scene.bone.tissues = {{"cancellous", 1850.0 * std::sqrt(0.1),
                           [](Vec3 p) { return std::abs(p.z + 0.5 * (first + second)) - 0.5 * (second - first); }},
                          {"cortical", 1850.0, {}}};
    const double beyond = scene.drill.point_depth() + scene.drill.radius() * std::tan(tilt) + 0.5_mm;
    const double last = (third + scene.drill.radius() * std::sin(tilt)) / std::cos(tilt) + beyond;
    const double reach = scene.drill.radius() + 1.0_mm;
    scene.bone.low = {-reach - 2.0_mm * std::sin(tilt), -reach, -third - 1.0_mm};
    scene.bone.high = {reach + last * std::sin(tilt), reach, 1.0_mm};
    scene.depth = {-1.0_mm - scene.drill.radius() * std::tan(tilt)};
    go_to(scene, last, scene.feed);
    return scene;
}

}  // namespace kerf::chart
