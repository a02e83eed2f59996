// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/powered/powered_scene.h"

#include <algorithm>
#include <cmath>

#include "kerf/units.hpp"
#include "studies/chart/setting.h"
#include "studies/chart/surfaces/burr_on_slab.h"

namespace kerf::chart {

using namespace literals;

void go_straight(std::vector<Pose>& path, Vec3 to, double speed) {
    const Pose from = path.back();
    const Vec3 way = to - from.position;
    const int ticks = std::max(1, static_cast<int>(std::ceil(length(way) / (speed * dt) - 1e-9)));
    for (int i = 1; i < ticks; ++i)
        path.push_back({from.position + (i * speed * dt / length(way)) * way, from.rotation});
    path.push_back({to, from.rotation});
}

double groove_volume(double radius, double depth, double along) noexcept {
    return slot_area(radius, depth) * along + 0.5 * dimple_volume(radius, depth);
}

PoweredScene powered_block(const PoweredScene& like, double reach, double across) {
    constexpr double above = 0.2_mm, room = 1.0_mm;
    PoweredScene scene = like;
    scene.id = like.cutter + "-block";
    scene.title = "Block";
    const auto hardest = std::max_element(like.bone.tissues.begin(), like.bone.tissues.end(),
                                          [](const auto& a, const auto& b) { return a.density < b.density; });
    scene.bone.surface = [](Vec3 p) { return p.z; };
    scene.bone.tissues = {{hardest->id, hardest->density, {}}};
    scene.bone.low = {-reach - room, -across - room, -like.trial_depth - 2.0 * room};
    scene.bone.high = {reach + room, across + room, room};
    scene.path = {{{0, 0, above}, quat_between({0, 0, 1}, {0, 0, -1})}};
    go_straight(scene.path, {0, 0, -like.trial_depth}, like.trial_feed);
    scene.feed = like.trial_feed;
    scene.volume.reset();
    return scene;
}

std::vector<PoweredScene> all_powered_scenes() { return {mandible_scene(), burr_groove_scene(), grazing_scene()}; }

}  // namespace kerf::chart
