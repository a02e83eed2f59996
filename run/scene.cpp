// SPDX-License-Identifier: Apache-2.0
#include "run/scene.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>

#include "bone/import/break_bone.h"
#include "bone/import/fit_landmarks.h"
#include "bone/import/make_body.h"
#include "core/field/fnv1a.h"
#include "core/haptics/loop/work_force.h"
#include "documents/check_needs.h"
#include "documents/fracture.h"
#include "documents/read_procedure.h"
#include "documents/yaml/document.h"
#include "run/device/simulated_handle.h"
#include "run/run_checks.h"
#include "run/staying_implant_body.h"
#include "run/thread_checks.h"
#include "run/verdict/measure_bone.h"
#include "text/codes.h"
#include "text/quantity.h"

namespace kerf::run {

namespace {

/// Returns the hash of a text and of its data files. Without files it is the hash of the text.
std::uint64_t hash_of(const std::string& text, const std::vector<std::uint64_t>& files) {
    Fnv1a hash;
    hash.add(text);
    for (const std::uint64_t file : files) hash.add_bytes(file, 8);
    return hash.value();
}

/// Makes the body of an implant, which is read like a bone of one tissue.
std::optional<Body> plate_body(const documents::Implant& implant, const documents::Procedure& procedure,
                               text::Diagnostics& diagnostics, bone::ImportReport& import) {
    documents::Anatomy surface;
    surface.file = procedure.file;
    surface.text = procedure.text;
    surface.within = {"implants", implant.id};
    surface.id = implant.id;
    if (implant.is_made_of_parts())
        surface.phantom = implant.solids;
    else
        surface.mesh = implant.mesh;
    surface.tissues.resize(1);
    surface.tissues.front().id = "metal";
    bone::ImportReport read;
    auto body = bone::make_body(surface,
                                implant.is_made_of_parts() ? documents::fitting_spacing(implant, procedure.spacing)
                                                           : procedure.spacing,
                                &read)
                    .take(diagnostics);
    if (!body) return std::nullopt;
    body->id = implant.id;
    import.file_hashes.insert(import.file_hashes.end(), read.file_hashes.begin(), read.file_hashes.end());
    return body;
}

/// Returns the sleeve of a step's instrument, on the step's axis.
std::optional<Guide> guide_of(const documents::Procedure& procedure, const documents::Step& step,
                              const AxisFrame& frame) {
    const auto instrument = std::find_if(procedure.instruments.begin(), procedure.instruments.end(),
                                         [&](const documents::Instrument& i) { return i.id == step.instrument; });
    if (instrument == procedure.instruments.end() || !instrument->guide) return std::nullopt;
    const documents::Sleeve& sleeve = *instrument->guide;
    return Guide{.body = 0,
                 .mouth = frame.entry - sleeve.gap * frame.along,
                 .along = frame.along,
                 .length = sleeve.length,
                 .bore_radius = 0.5 * sleeve.bore};
}

/// Returns the force that the hardest tissue needs at the steps' feeds [N].
double hardest_of_steps(const Scene& scene) {
    double hardest = 0.0;
    for (std::size_t s = 0; s < scene.procedure.steps.size(); ++s)
        if (!scene.tool(s).outline.has_thread())  // a screw is turned in, not fed
            hardest = std::max(hardest, work_force(scene.tool(s).setup, scene.body, scene.procedure.steps[s].feed));
    return hardest;
}

/// Returns the forces at a step's feed, every 0.5 mm of its axis in bone down to its goal [N]. Empty for a step without
/// depth, and for a screw or a tap, which are turned in.
std::vector<double> forces_along(const Scene& scene, std::size_t step) {
    const documents::Step& asked = scene.procedure.steps[step];
    double depth = 0.0;
    for (const documents::Goal& goal : asked.goals)
        if (goal.quantity == "depth") depth = std::max(depth, goal.bound.at_least.value_or(0.0));
    if (depth <= 0.0 || scene.tool(step).outline.has_thread()) return {};
    std::vector<double> forces;
    const EndlessBoneLaw law(scene.tool(step).setup, scene.body.materials.size());
    const AxisFrame& frame = scene.frames[step];
    constexpr double apart = 0.5e-3, marrow = 100.0;  // [m]; [kg/m³] up to which no force is expected
    for (double at = 0.5 * apart; at < depth; at += apart) {
        const LocatedPoint place = locate(scene.body, frame.entry + at * frame.along);
        if (uncut_distance(scene.body, place) >= 0.0) continue;
        double weight[KERF_MAX_TISSUES];
        material_weights(scene.body, place, weight);
        const auto most =
            static_cast<std::size_t>(std::max_element(weight, weight + scene.body.materials.size()) - weight);
        const Material& material = scene.body.materials[most];
        const double density = material.densities.at(place, material.density);
        if (density > marrow) forces.push_back(law.force(most, density, asked.feed));
    }
    return forces;
}

/// Returns a lower bound of the time that a hand needs for its legs [s].
double min_time_of(const HandPlan& plan) {
    double time = 0.0;
    Vec3 from = plan.start.position;
    for (const simulated_hand::Leg& leg : plan.intent.legs) {
        if (leg.can_end_early()) continue;
        time += std::max(length(leg.target.position - from) / leg.speed, std::abs(leg.turn) / leg.turning) +
                leg.min_regrip_time();
        from = leg.target.position;
    }
    return time;
}

const documents::LandmarkAxis* find_axis(const documents::Anatomy& anatomy, const std::string& id) {
    const auto found = std::find_if(anatomy.axes.begin(), anatomy.axes.end(),
                                    [&](const documents::LandmarkAxis& a) { return a.id == id; });
    return found != anatomy.axes.end() ? &*found : nullptr;
}

/// Finds the planned pose of each implant that has one.
void plan_implants(Scene& scene, text::Diagnostics& diagnostics) {
    const std::vector<documents::Step>& steps = scene.procedure.steps;
    for (std::size_t i = 0; i < scene.implants.size(); ++i) {
        const documents::Implant& implant = scene.procedure.implants[i];
        scene.planned.emplace_back();
        if (!implant.place) continue;
        const documents::LandmarkAxis& axis = *find_axis(scene.anatomy, implant.place->axis);
        const bone::AxisInBone found = bone::axis_in_bone(scene.body, axis);
        if (found.entry < 0.0) {
            if (std::none_of(steps.begin(), steps.end(),
                             [&](const documents::Step& step) { return step.axis == axis.id; }))
                bone::check_axis(scene.anatomy, axis, found, diagnostics);
            continue;
        }
        const Vec3 along = normalized(axis.to - axis.from);
        scene.planned.back() = documents::planned_pose(axis.from + found.entry * along, along, implant.place->up);
        check_plate(scene.procedure, implant, fit_of(scene.implants[i], *scene.planned.back(), BoneAround(scene.body)),
                    diagnostics);
    }
}

/// Finds the steps that follow holes of planned implants.
void find_step_holes(Scene& scene, text::Diagnostics& diagnostics) {
    const std::vector<documents::Implant>& implants = scene.procedure.implants;
    std::vector<std::vector<documents::HoleInMetal>> metal;
    for (std::size_t i = 0; i < implants.size(); ++i) {
        const Body& body = scene.implants[i];
        metal.push_back(check_holes(
            scene.procedure, implants[i], [&](Vec3 p) { return uncut_distance(body, locate(body, p)); }, diagnostics));
    }
    for (std::size_t s = 0; s < scene.procedure.steps.size(); ++s) {
        const auto named = hole_of_step(scene.procedure, scene.procedure.steps[s]);
        if (!named) continue;
        const auto i = static_cast<std::size_t>(named->implant - implants.data());
        const auto h = static_cast<std::size_t>(named->hole - named->implant->holes.data());
        scene.holes.push_back({s, i, *named->hole, metal[i][h]});
    }
}

const StepHole* find_hole(const Scene& scene, std::size_t step) {
    const auto found =
        std::find_if(scene.holes.begin(), scene.holes.end(), [&](const StepHole& hole) { return hole.step == step; });
    return found != scene.holes.end() ? &*found : nullptr;
}

/// Adds the frame of a step on a hole of an implant, at its planned pose.
bone::AxisInBone add_frame_of_hole(Scene& scene, const StepHole& hole, text::Diagnostics& diagnostics) {
    const documents::Implant& implant = scene.procedure.implants[hole.implant];
    const Pose& planned = *scene.planned[hole.implant];
    const documents::Step& step = scene.procedure.steps[hole.step];
    const bone::AxisInBone found = bone::axis_in_bone(scene.body, documents::axis_of(hole.hole, planned, step.axis));
    const auto refuse = [&](text::Code code, const std::string& message) {
        const auto document = documents::document_of(scene.procedure);
        const documents::Node* node = &document->root;
        for (const std::string& key : {std::string("implants"), implant.id, std::string("holes"), hole.hole.id})
            node = node != nullptr ? node->find(key) : nullptr;
        documents::Report(*document, diagnostics)
            .error(code, node != nullptr ? node->key_span : documents::TextSpan{},
                   "The hole `" + step.axis + "` " + message);
    };
    if (found.entry < 0.0)
        refuse(text::Code::plate_off_bone,
               "leads past the bone: at the planned pose its axis meets none between `from` and `to`. Move the hole, "
               "write a `to:` farther in, or turn the implant with `up:`.");
    else if (found.begins_inside())
        refuse(text::Code::axis_begins_in_bone,
               "leads out of the bone: at the planned pose `from` lies " +
                   text::quantity_text(std::round(1e4 * found.inside) * 1e-4, "mm") +
                   " inside it. Exchange `from` and `to`: z of a plate points into the bone.");
    scene.frames.push_back(
        frame_of(hole, planned, BoneAround(scene.body), scene.anatomy, plane_of(step, scene.anatomy)));
    return found;
}

/// Returns whether no step before the one that gets the next frame has the same axis.
bool is_new_axis(const Scene& scene) {
    const std::vector<documents::Step>& steps = scene.procedure.steps;
    const std::size_t next = scene.frames.size();
    return std::none_of(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(next),
                        [&](const documents::Step& earlier) { return earlier.axis == steps[next].axis; });
}

}  // namespace

const documents::Instrument& instrument_of(const Scene& scene, std::size_t tool) {
    const auto step =
        std::find(scene.tool_of_step.begin(), scene.tool_of_step.end(), tool) - scene.tool_of_step.begin();
    const std::string& id = scene.procedure.steps[static_cast<std::size_t>(step)].instrument;
    return *std::find_if(scene.procedure.instruments.begin(), scene.procedure.instruments.end(),
                         [&](const documents::Instrument& i) { return i.id == id; });
}

const documents::LandmarkPlane* plane_of(const documents::Step& step, const documents::Anatomy& anatomy) {
    const auto plane = std::find_if(anatomy.planes.begin(), anatomy.planes.end(),
                                    [&](const documents::LandmarkPlane& p) { return p.id == step.plane; });
    return plane != anatomy.planes.end() ? &*plane : nullptr;
}

text::Result<Scene> make_scene(Documents documents, const bone::ImportOptions& options) {
    text::Diagnostics diagnostics;
    Scene scene;
    scene.procedure = std::move(documents.procedure);
    scene.anatomy = std::move(documents.anatomy);
    scene.device = documents.device;
    scene.tools = std::move(documents.tools);
    scene.tool_of_step = std::move(documents.tool_of_step);

    bone::ImportReport& import = scene.import;
    auto body = bone::make_body(scene.anatomy, scene.procedure.spacing, &import, options).take(diagnostics);
    if (!body || text::has_error(diagnostics)) return diagnostics;
    scene.body = std::move(*body);
    bone::use_fits(scene.anatomy, import);
    documents::check_axes_in_planes(scene.procedure, scene.anatomy, diagnostics);
    for (std::size_t tool = 0; tool < scene.tools.size(); ++tool) {
        check_blade_fits(scene.procedure, instrument_of(scene, tool).id, scene.tools[tool].outline.cutting,
                         scene.body.region, diagnostics);
    }
    for (std::size_t tool = 0; tool < scene.tools.size(); ++tool) {
        const documents::Instrument& instrument = instrument_of(scene, tool);
        scene.staying.emplace_back();
        if (instrument.is_inserted && scene.tools[tool].outline.is_implant())
            scene.staying.back() =
                staying_implant_body(scene.tools[tool].outline, instrument.id, scene.procedure.spacing);
    }
    for (const documents::Implant& implant : scene.procedure.implants) {
        auto metal = plate_body(implant, scene.procedure, diagnostics, import);
        if (!metal) return diagnostics;
        scene.implants.push_back(std::move(*metal));
    }
    plan_implants(scene, diagnostics);
    find_step_holes(scene, diagnostics);
    if (text::has_error(diagnostics)) return diagnostics;
    import.file_hashes.insert(import.file_hashes.end(), documents.markup_hashes.begin(), documents.markup_hashes.end());
    scene.anatomy_hash = hash_of(scene.anatomy.text, import.file_hashes);
    std::vector<const ToolOutline*> outlines;
    for (const std::size_t tool : scene.tool_of_step) outlines.push_back(&scene.tools[tool].outline);
    for (const auto& step : scene.procedure.steps) {
        bone::AxisInBone found;
        if (const StepHole* hole = find_hole(scene, scene.frames.size())) {
            found = add_frame_of_hole(scene, *hole, diagnostics);
        } else {
            const documents::LandmarkAxis& axis = *find_axis(scene.anatomy, step.axis);
            found = bone::axis_in_bone(scene.body, axis);
            if (is_new_axis(scene)) bone::check_axis(scene.anatomy, axis, found, diagnostics);
            scene.frames.push_back(axis_frame(axis, found.entry, scene.anatomy, plane_of(step, scene.anatomy)));
        }
        scene.frames.back().inwards = bone::into_surface(scene.body, scene.frames.back().entry);
        scene.fraction_in_bone.push_back(found.share);
        scene.guides.push_back(guide_of(scene.procedure, step, scene.frames.back()));
        const std::size_t index = scene.frames.size() - 1;
        if (found.entry >= 0.0)
            check_screw_in_bone(scene.procedure, outlines, index, scene.frames.back(), scene.body, diagnostics);
    }
    if (text::has_error(diagnostics)) return diagnostics;
    std::vector<const ToolSolid*> cutting;
    for (std::size_t s = 0; s < scene.procedure.steps.size(); ++s) cutting.push_back(&scene.tool(s).outline.cutting);
    check_waypoints_in_region(scene.procedure, scene.frames, cutting, scene.body, diagnostics);

    scene.work_force = scene.procedure.working_force.value_or(hardest_of_steps(scene));
    scene.gains = in_hands(gains_for(
        *scene.device, scene.procedure.force_scale.value_or(force_scale_for(*scene.device, scene.work_force))));
    check_force_scale(scene.procedure, *scene.device, scene.work_force, diagnostics);
    for (std::size_t s = 0; s < scene.procedure.steps.size(); ++s)
        check_felt(scene.procedure, s, forces_along(scene, s), *scene.device, scene.gains.force_scale, diagnostics);
    if (scene.anatomy.fracture) {
        scene.whole = scene.body;
        scene.fragment = bone::break_bone(scene.body, scene.anatomy, import).take(diagnostics);
        if (!scene.fragment) return diagnostics;
        scene.world_from_fragment = documents::world_from_fragment(*scene.anatomy.fracture);
    }
    measure_before_cuts(scene, diagnostics);
    if (text::has_error(diagnostics)) return diagnostics;
    for (std::size_t r = 0; r < scene.procedure.rehearsals.size(); ++r)
        check_time(scene.procedure, r, min_time_of(plan_of(scene.procedure.rehearsals[r], scene)), diagnostics);
    return {std::move(scene), std::move(diagnostics)};
}

text::Result<Scene> make_scene(const std::string& procedure_file, const std::string& anatomy_file,
                               const PluginRegistry& plugins, const bone::ImportOptions& options) {
    text::Diagnostics diagnostics;
    auto documents = check_documents({procedure_file, anatomy_file}, plugins).take(diagnostics);
    if (!documents) return diagnostics;
    auto scene = make_scene(std::move(*documents), options).take(diagnostics);
    if (!scene) return diagnostics;
    return {std::move(*scene), std::move(diagnostics)};
}

HandPlan plan_of(const documents::Rehearsal& rehearsal, const Scene& scene) {
    HandPlan plan;
    plan.plant = plant_at(*scene.device, scene.gains.force_scale);
    plan.intent.reaction = rehearsal.reaction;

    const auto pose_at = [&](const documents::Waypoint& waypoint) {
        const Pose planned = scene.frames[waypoint.step].pose_at(waypoint);
        return waypoint.is_displaced ? scene.world_from_fragment * planned : planned;
    };
    plan.start = pose_at(rehearsal.path.front());
    plan.inputs.push_back(rehearsal.path.front().inputs);
    for (std::size_t i = 1; i < rehearsal.path.size(); ++i) {
        plan.inputs.push_back(rehearsal.path[i].inputs);
        const documents::Waypoint &from = rehearsal.path[i - 1], &to = rehearsal.path[i];
        const bool is_into_bone = to.step == from.step && to.depth > from.depth && to.depth > 0.0;
        simulated_hand::Leg leg{.target = pose_at(to),
                                .speed = to.speed.value_or(is_into_bone ? rehearsal.feed : rehearsal.approach),
                                .push = to.push.value_or(rehearsal.push) * scene.gains.force_scale,
                                .skip_distance = to.skip_distance};
        if (to.turn != 0.0) {  // the plan advances as the thread pulls the tool in
            leg.turn = to.turn;
            leg.turning = 2.0 * std::numbers::pi * to.turning;
            if (to.turn_torque) leg.torque = *to.turn_torque;
            if (to.until_torque) leg.until_torque = *to.until_torque;
            leg.until_event = to.until_event;
            leg.regrip = to.regrip;
            const double distance = length(leg.target.position - pose_at(from).position);
            if (!to.speed && distance > 0.0) leg.speed = distance * leg.turning / std::abs(leg.turn);
        }
        plan.intent.legs.push_back(leg);
    }
    return plan;
}

}  // namespace kerf::run
