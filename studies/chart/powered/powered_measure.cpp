// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/powered/powered_measure.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "kerf/assert.hpp"
#include "kerf/units.hpp"
#include "studies/chart/trial.h"

namespace kerf::chart {

using namespace literals;

namespace {

/// The block of a scene's cutter, as wide as the cutter is.
PoweredScene block_of(const Plugins& plugins, const PoweredScene& scene) {
    ToolOutline outline;
    std::string error;
    const bool is_made = outline_of(tool_of(plugins, scene, scene.usual_points), outline, error);
    KERF_ASSERT(is_made, "a tool of a scene can be made");
    const double reach = outline.cutting.largest_radius();
    return powered_block(scene, reach, outline.cutting.is_prism() ? 0.5 * outline.cutting.thickness() : reach);
}

std::vector<Felt> felt_along(Run& run, const PoweredScene& scene) {
    std::vector<Felt> felt;
    for (std::size_t t = 0; t < scene.ticks(); ++t) felt.push_back(run.tick(scene.path[t + 1]));
    return felt;
}

}  // namespace

Measured measure_powered(const Plugins& plugins, const PoweredMethod& method, const PoweredScene& scene,
                         const PoweredReference& prescribed, const Fineness& fineness, int grids, double gain) {
    ErrorSum errors(false, scene.line);
    for (int g = 0; g < grids; ++g) {
        Fineness shifted = fineness;
        shifted.offset = grid_shift(g);
        const auto run = method.start(scene, shifted, gain);
        Track track;
        track.felt = felt_along(*run, scene);
        const PoweredReference reference =
            method.is_solved ? reference_along(plugins, scene, motion_of(track.felt), false) : prescribed;
        track.reference = reference.wrench;
        track.is_exact = reference.is_exact;
        track.is_compared.assign(track.felt.size(), true);
        track.volume_reference = reference.volume;
        track.volume = run->removed_volume();
        errors.add(track);
    }
    Measured measured = errors.measured();
    measured.gain = gain;
    return measured;
}

double powered_calibration(const Plugins& plugins, const PoweredMethod& method, const PoweredScene& scene,
                           const Fineness& fineness) {
    if (!method.is_calibrated) return 1.0;
    const PoweredScene block = block_of(plugins, scene);
    const auto run = method.start(block, {fineness.spacing, fineness.points, grid_shift(0)}, 1.0);
    const std::vector<Felt> felt = felt_along(*run, block);
    const PoweredReference reference = reference_along(plugins, block, prescribed_motion(block), true);
    double sum = 0.0, right = 0.0;
    for (std::size_t t = 0; t < felt.size(); ++t) {
        if (block.path[t].position.z > -block.trial_depth + 1.0_mm) continue;
        sum += felt[t].wrench[2];
        right += reference.wrench[t][2];
    }
    return std::abs(sum) > 1e-12 ? std::abs(right / sum) : 1.0;  // a law that pulls the tool in still does
}

Standing powered_standing(const Plugins& plugins, const PoweredMethod& method, const PoweredScene& scene,
                          const Fineness& fineness) {
    PoweredScene block = block_of(plugins, scene);
    const double gain = powered_calibration(plugins, method, scene, fineness);
    Trial trial{.start =
                    [&](double more_points) {
                        const int points = static_cast<int>(std::lround(more_points * fineness.points));
                        return method.start(block, {fineness.spacing, points, grid_shift(0)}, gain);
                    },
                .pose_at =
                    [&](double depth) {
                        return Pose{{0, 0, -depth}, block.path.front().rotation};
                    },
                .feed = scene.trial_feed,
                .bottom = scene.trial_depth - 0.3_mm,
                .top = 0.3_mm};
    // As many points as the law takes: where it has no more, half of them are compared with all.
    const bool is_most = !scene.points_sweep.empty() && 2 * fineness.points > scene.points_sweep.back();
    trial.more_points = is_most && method.more_points > 0.0 ? 0.5 : method.more_points;
    for (const Pose& pose : block.path) trial.depth.push_back(-pose.position.z);

    Standing standing{.method = method.id, .knob = knob_text(method.knob, fineness), .cutter = scene.cutter};
    standing.add_trials(trial, method.is_solved);
    return standing;
}

}  // namespace kerf::chart
