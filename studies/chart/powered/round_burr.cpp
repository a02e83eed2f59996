// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/powered/round_burr.h"

#include "kerf/units.hpp"
#include "studies/chart/powered/exact_burr.h"

namespace kerf::chart {

using namespace literals;

PoweredScene round_burr_scene(double diameter, double spindle_speed, double feed) {
    PoweredScene scene;
    scene.cutter = "burr";
    scene.tool = {
        .plugin = "kerf.burring",
        .tool = "round_burr",
        .force = "burr_cutting",
        .set = {
            {"diameter", diameter}, {"spindle_speed", spindle_speed}, {"run_up", 0.0}}};  // the motor follows at once
    scene.points = "edge_points";
    scene.usual_points = 84;
    scene.points_sweep = {24, 48, 84, 168, 336};
    scene.spacing_sweep = {0.5_mm, 0.25_mm, 0.125_mm};
    scene.feed = feed;
    scene.trial_depth = 1.6_mm;
    scene.trial_feed = 0.5_mm_per_s;
    scene.needs = BallBurr::parameters();
    scene.exact = [](const PoweredScene& in, const Values& values) -> std::unique_ptr<ExactCut> {
        return std::make_unique<ExactBurr>(in.bone, BallBurr(values));
    };
    scene.line = TorqueLine{{}, {0, 0, 1}};
    return scene;
}

}  // namespace kerf::chart
