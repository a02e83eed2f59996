// SPDX-License-Identifier: Apache-2.0
#include "run/cut_results.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace kerf {

std::optional<CutWall> wall_of(const Scene& scene, const Simulation& simulation, const CutBefore& before,
                               const StepMonitor& monitor, std::size_t step) {
    const AxisFrame& frame = scene.frames[step];
    if (frame.across == Vec3{}) return {};
    const WallWindow window{.entry = frame.entry,
                            .along = frame.along,
                            .normal = frame.across,
                            .half_width = scene.tool(step).outline.cutting.largest_radius(),
                            .depth = std::max(0.0, monitor.steps()[step].deepest)};
    std::vector<Vec3> points;
    const PresentBone& bone = simulation.present();
    for (std::size_t body = 0; body < bone.count(); ++body) {
        const Body& whole = *bone.piece(body).bone;
        std::vector<Vec3> some;
        add_wall_points(whole, bone.cut(body), window, some);
        std::copy_if(some.begin(), some.end(), std::back_inserter(points),
                     [&](Vec3 p) { return !before.reaches(whole, body, p); });
    }
    return fit_wall(points, window, scene.tool(step).outline.cutting.thickness());
}

std::optional<HoleResult> hole_of(const Scene& scene, const Simulation& simulation, const CutBefore& before,
                                  const StepMonitor& monitor, std::size_t step) {
    const ToolSolid& cutting = scene.tool(step).outline.cutting;
    const StepState& state = monitor.steps()[step];
    if (cutting.is_prism() || cutting.outline().empty() || !state.step->has_depth() || !state.has_cut_bone()) return {};
    const AxisFrame& frame = scene.frames[step];
    const std::size_t owner = monitor.owners().step[step];
    const PresentBone& bone = simulation.present();
    const Body& body = *bone.piece(owner).bone;
    const CutField& cut = bone.cut(owner);
    const double spacing = body.grid().spacing;
    const HolePlan plan{.entry = frame.entry, .along = frame.along, .depth = state.advance.front, .cutting = cutting};
    HoleResult result;
    result.hole = measure_hole(body, plan, [&](Vec3 p) {
        const BrickPlace place = locate(body, p);
        const double was = std::clamp(0.5 - uncut_distance(body, place) / spacing, 0.0, 1.0),
                     gone = std::clamp(0.5 + cut.at(place) / spacing, 0.0, 1.0);
        return was <= 0.0 || gone <= 0.0 ? 0.0 : was * std::max(0.0, gone - before.share_gone(body, owner, p));
    });
    if (!result.hole) return result;
    // Medial and lateral, cranial and caudal; without the landmark `midline` the sides have no names.
    const Vec3 to_side =
        frame.medial != Vec3{} ? frame.medial : rotate(quat_between({0, 0, 1}, frame.along), {1, 0, 0});
    const Vec3 up = cross(to_side, frame.along);
    for (const Limit& limit : state.step->limits)
        if (limit.quantity == "breach")
            result.breaches.emplace_back(limit.diameter, breach_of(body, plan, *result.hole, 0.5 * limit.diameter,
                                                                   to_side, up.z >= 0.0 ? up : -up));
    return result;
}

}  // namespace kerf
