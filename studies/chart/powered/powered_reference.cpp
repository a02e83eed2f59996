// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/powered/powered_reference.h"

#include <algorithm>
#include <cstddef>

#include "kerf/units.hpp"
#include "studies/chart/kerf_run.h"
#include "studies/chart/powered/powered_methods.h"

namespace kerf::chart {

using namespace literals;

namespace {

struct Replayed {
    std::vector<Vec6> wrench;
    double volume = 0.0;
};

Replayed replay_at(const Plugins& plugins, const PoweredScene& scene, const Motion& motion, double spacing) {
    const int points = scene.points_sweep.empty() ? scene.usual_points : scene.points_sweep.back();
    KerfRun run({scene.bone, tool_of(plugins, scene, points), motion.from.front(), scene.feed, scene.working_force},
                {spacing, points, {0.41, 0.77, 0.23}}, KerfRun::Way::direct);
    Replayed replayed;
    for (std::size_t t = 0; t < motion.from.size(); ++t) {
        const Pose& from = motion.from[t];
        const Vec6& rate = motion.rate[t];
        const Pose next = t + 1 < motion.from.size()
                              ? motion.from[t + 1]
                              : from * Pose{dt * linear(rate), quat_from_rotation_vector(dt * angular(rate))};
        replayed.wrench.push_back(run.tick(next).wrench);
    }
    replayed.volume = run.removed_volume();
    return replayed;
}

}  // namespace

Motion prescribed_motion(const PoweredScene& scene) {
    Motion motion;
    for (std::size_t t = 0; t < scene.ticks(); ++t) {
        motion.from.push_back(scene.path[t]);
        motion.rate.push_back(rate_between(scene.path[t], scene.path[t + 1]));
    }
    return motion;
}

Motion motion_of(const std::vector<Felt>& felt) {
    Motion motion;
    for (const Felt& one : felt) {
        motion.from.push_back(one.from);
        motion.rate.push_back(one.rate);
    }
    return motion;
}

PoweredReference reference_along(const Plugins& plugins, const PoweredScene& scene, const Motion& motion,
                                 bool is_prescribed) {
    PoweredReference reference;
    const auto exact = scene.exact(scene, scene.tool.all(*plugins.own));
    for (std::size_t t = 0; t < motion.from.size(); ++t) {
        const std::optional<Vec6> wrench = exact->tick(motion.from[t], motion.rate[t]);
        reference.wrench.push_back(wrench.value_or(Vec6{}));
        reference.is_exact.push_back(wrench.has_value());
    }
    if (std::find(reference.is_exact.begin(), reference.is_exact.end(), false) == reference.is_exact.end()) {
        reference.volume = is_prescribed && scene.volume ? *scene.volume : exact->volume();
        return reference;
    }
    const double coarse = replay_at(plugins, scene, motion, 0.2_mm).volume;
    const Replayed fine = replay_at(plugins, scene, motion, 0.1_mm);
    for (std::size_t t = 0; t < motion.from.size(); ++t)
        if (!reference.is_exact[t]) reference.wrench[t] = fine.wrench[t];
    reference.volume = fine.volume + (fine.volume - coarse) / 3.0;
    return reference;
}

}  // namespace kerf::chart
