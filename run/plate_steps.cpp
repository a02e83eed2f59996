// SPDX-License-Identifier: Apache-2.0
#include "run/plate_steps.h"

#include <algorithm>
#include <cstddef>

#include "bone/import/make_body.h"

namespace kerf::run {

namespace {

/// Returns the present pose of the last inserted implant of this kind; nothing if there is none in the scene.
std::optional<Pose> pose_in_scene(const Body& implant, const Simulation& simulation) {
    std::optional<Pose> pose;
    for (const auto& body : simulation.bodies())
        if (body->bone == &implant && body->is_present) pose = body->world_from_body;
    return pose;
}

AxisFrame in_other_frame(const Pose& other_from_frame, AxisFrame frame) {
    frame.entry = other_from_frame * frame.entry;
    for (Vec3* direction : {&frame.along, &frame.medial, &frame.across})
        *direction = rotate(other_from_frame.rotation, *direction);
    return frame;
}

}  // namespace

void follow_plates(const Scene& scene, const Simulation& simulation, StepMonitor& monitor) {
    const BoneAround bone(simulation);
    for (const StepHole& hole : scene.holes) {
        const auto pose = pose_in_scene(scene.implants[hole.implant], simulation);
        if (!pose) {
            monitor.set_frame(hole.step, scene.frames[hole.step]);
            continue;
        }
        const LiveBody& owner = *simulation.bodies()[monitor.owners().step[hole.step]];
        AxisFrame frame = in_other_frame(
            inverse(owner.world_from_body),
            frame_of(hole, *pose, bone, scene.anatomy, plane_of(scene.procedure.steps[hole.step], scene.anatomy)));
        frame.inwards = bone::into_surface(*owner.bone, frame.entry);
        monitor.set_frame(hole.step, frame);
    }
}

std::optional<Guide> guide_of_step(const Scene& scene, const StepMonitor& monitor) {
    const std::size_t step = monitor.current();
    std::optional<Guide> guide = scene.guides[step];
    if (!guide) return guide;
    guide->body = monitor.owners().step[step];
    const AxisFrame &planned = scene.frames[step], &now = monitor.frame(step);
    if (!now.plate) return guide;
    guide->mouth = now.entry + planned.depth_of(guide->mouth) * now.along;
    guide->along = now.along;
    return guide;
}

}  // namespace kerf::run
