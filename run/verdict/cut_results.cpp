// SPDX-License-Identifier: Apache-2.0
#include "run/verdict/cut_results.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "run/verdict/screw_grade.h"

namespace kerf::run {

namespace {

/// Finds breaches of cylinders along a hole.
class BreachesAlong {
public:
    /// Directions: medial and lateral, cranial and caudal. Without the landmark `midline` the sides have no names.
    BreachesAlong(const Body& body, const bone::HolePlan& plan, const AxisFrame& frame, const bone::DrilledHole& hole)
        : body_(&body), plan_(&plan), hole_(&hole) {
        to_side_ = frame.medial != Vec3{} ? frame.medial : rotate(quat_between({0, 0, 1}, frame.along), {1, 0, 0});
        up_ = cross(to_side_, frame.along);
        if (up_.z < 0.0) up_ = -up_;
    }
    [[nodiscard]] bone::Breach of(double radius, bone::DepthRange range = {}) const {
        return bone::breach_of(*body_, *plan_, *hole_, radius, to_side_, up_, range);
    }

private:
    const Body* body_;
    const bone::HolePlan* plan_;
    const bone::DrilledHole* hole_;
    Vec3 to_side_, up_;
};

void add_breaches(const BreachesAlong& along, const documents::Step& step, HoleResult& result) {
    for (const documents::Limit& limit : step.limits)
        if (limit.quantity == "breach") result.breaches.emplace_back(limit.diameter, along.of(0.5 * limit.diameter));
}

/// Returns the parts of a vertebra in which a screw of this radius leaves the bone.
BreachLocations breach_locations_of(const BreachesAlong& along, const bone::DrilledHole& axis, double radius,
                                    bool is_tip_out) {
    const bone::Breach pedicle = along.of(radius, {0.0, axis.waist_end}),
                       body = along.of(radius, {axis.waist_end, HUGE_VAL});
    enum { medial, lateral, cranial, caudal };
    // An oblique breach counts for the side on which it is deepest.
    const auto is_worst = [&](int side) {
        const double there = pedicle.towards[static_cast<std::size_t>(side)];
        return there > 0.0 && there == pedicle.worst();
    };
    return {.lateral_of_pedicle = is_worst(lateral) || is_worst(cranial),
            .medial_of_pedicle = is_worst(medial) || is_worst(caudal),
            .of_body = is_tip_out || body.worst() > 0.0,
            .in_zone = false};
}

/// Returns the distance of a screw's core to the nearest zone [m]; negative inside.
double clearance_of(const ToolSolid& core, const Pose& world_from_screw, const documents::Anatomy& anatomy) {
    double least = HUGE_VAL;
    for (const documents::Zone& zone : anatomy.zones) least = std::min(least, clearance(core, world_from_screw, zone));
    return least;
}

}  // namespace

std::optional<bone::CutWall> wall_of(const Scene& scene, const Simulation& simulation, const EarlierCut& before,
                                     const StepMonitor& monitor, std::size_t step) {
    const AxisFrame& frame = monitor.frame(step);
    if (frame.across == Vec3{}) return {};
    const bone::WallWindow window{.entry = frame.entry,
                                  .along = frame.along,
                                  .normal = frame.across,
                                  .half_width = scene.tool(step).outline.cutting.largest_radius(),
                                  .depth = std::max(0.0, monitor.steps()[step].deepest)};
    std::vector<Vec3> points;
    const PresentBone& bone = simulation.present();
    for (std::size_t body = 0; body < bone.count(); ++body) {
        const Body& whole = *bone.piece(body).bone;
        std::vector<Vec3> some;
        bone::add_wall_points(whole, bone.cut(body), window, some);
        std::copy_if(some.begin(), some.end(), std::back_inserter(points),
                     [&](Vec3 p) { return !before.reaches(whole, body, p); });
    }
    return bone::fit_wall(points, window, scene.tool(step).outline.cutting.thickness());
}

std::optional<HoleResult> hole_of(const Scene& scene, const Simulation& simulation, const EarlierCut& before,
                                  const StepMonitor& monitor, std::size_t step) {
    const ToolSolid& cutting = scene.tool(step).outline.cutting;
    const StepState& state = monitor.steps()[step];
    if (cutting.is_prism() || cutting.outline().empty() || !state.step->has_depth() || !state.has_cut_bone()) return {};
    const AxisFrame& frame = monitor.frame(step);
    const std::size_t owner = monitor.owners().step[step];
    const PresentBone& bone = simulation.present();
    const Body& body = *bone.piece(owner).bone;
    const CutField& cut = bone.cut(owner);
    const double spacing = body.grid().spacing;
    const bone::HolePlan plan{
        .entry = frame.entry, .along = frame.along, .depth = state.advance.front, .cutting = cutting};
    HoleResult result;
    result.hole = bone::measure_hole(body, plan, [&](Vec3 p) {
        const LocatedPoint place = locate(body, p);
        const double was = std::clamp(0.5 - uncut_distance(body, place) / spacing, 0.0, 1.0),
                     gone = std::clamp(0.5 + cut.at(place) / spacing, 0.0, 1.0);
        if (was <= 0.0 || gone <= 0.0) return bone::Drilled{};
        const double gone_before = std::min(gone, before.fraction_removed(body, owner, p));
        return bone::Drilled{was * (gone - gone_before), was * gone_before};
    });
    if (!result.hole) return result;
    add_breaches(BreachesAlong(body, plan, frame, *result.hole), *state.step, result);
    return result;
}

std::optional<HoleResult> screw_of(const Scene& scene, const Simulation& simulation, const StepMonitor& monitor,
                                   std::size_t step) {
    if (!monitor.steps()[step].has_cut_bone()) return {};
    const std::size_t owner = monitor.owners().step[step];
    // A screw through a fracture is measured in the whole bone.
    return screw_at(scene, step, monitor.frame(step),
                    scene.whole ? *scene.whole : *simulation.present().piece(owner).bone,
                    inverse(simulation.bodies()[owner]->world_from_body) * simulation.world_from_tool());
}

HoleResult screw_at(const Scene& scene, std::size_t step, const AxisFrame& frame, const Body& body, const Pose& screw) {
    const ToolOutline& outline = scene.tool(step).outline;
    const bone::HolePlan plan{.entry = frame.entry,
                              .along = frame.along,
                              .depth = frame.depth_of(screw.position),
                              .cutting = outline.cutting};
    HoleResult result;
    result.hole = bone::hole_along(body, plan, screw.position, rotate(screw.rotation, {0, 0, 1}));
    if (!result.hole) return result;
    const BreachesAlong along(body, plan, frame, *result.hole);
    add_breaches(along, scene.procedure.steps[step], result);
    const double radius = outline.thread_radius, unsure = 0.5 * body.grid().spacing;
    result.screw = InsertedScrew{.diameter = 2.0 * radius,
                                 .breach = along.of(radius),
                                 .least = along.of(radius - unsure).worst(),
                                 .most = along.of(radius + unsure).worst()};
    if (frame.plate) {
        const Vec3 middle = frame.entry + *frame.plate * frame.along, axis = rotate(screw.rotation, {0, 0, 1});
        const double cosine = dot(axis, frame.along);  // a screw at more than 60° to the axis was excluded above
        const Vec3 there = screw.position + dot(middle - screw.position, frame.along) / cosine * axis;
        result.screw->hole_offset = length(there - middle);
        result.screw->hole_angle = std::atan2(length(cross(axis, frame.along)), cosine);
    }
    if (frame.medial == Vec3{}) return result;  // the sides have no names
    const double tip = uncut_distance(body, locate(body, screw.position)),
                 zone = clearance_of(outline.cutting, screw, scene.anatomy);
    const auto places = [&](double by) {
        BreachLocations found = breach_locations_of(along, *result.hole, radius + by, tip + by >= 0.0);
        found.in_zone = zone - by < 0.0;
        return found;
    };
    result.screw->heary_grade = heary(places(-unsure), places(unsure));
    return result;
}

}  // namespace kerf::run
