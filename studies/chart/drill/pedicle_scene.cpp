// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include <algorithm>
#include <cmath>
#include <string>

#include "documents/read_anatomy.h"
#include "documents/solids.h"
#include "kerf/assert.hpp"
#include "kerf/units.hpp"
#include "studies/chart/drill/scene.h"
#include "studies/chart/drill/vertebra_phantom.h"  // the text of the anatomy, put there by CMakeLists.txt
#include "studies/drawing/svg.h"

namespace kerf::chart {

using namespace literals;

namespace {

/// How a way into the pedicle differs from the planned axis, and what cortex it meets.
struct Way {
    double medial = 0.0;  ///< [m] beside it
    AwlAim aim{};
};

Scene scene_on(const Way& way) {
    text::Diagnostics diagnostics;
    const auto anatomy = documents::read_anatomy_text("vertebra-l4-phantom.yaml", vertebra_phantom).take(diagnostics);
    KERF_ASSERT(anatomy && anatomy->tissues.size() == 2 && !anatomy->axes.empty(),
                "the anatomy in procedures/ reads without error");
    Scene scene;
    scene.drill.diameter = 3.2_mm;
    scene.drill.point_angle = 118.0_deg;
    scene.is_oblique = true;
    scene.bone.surface = [phantom = anatomy->phantom](Vec3 p) { return distance_to(phantom, p); };
    const double shell = way.aim.shell.value_or(anatomy->tissues.front().thickness);
    scene.bone.tissues = {{anatomy->tissues[1].id, anatomy->tissues[1].density,
                           [surface = scene.bone.surface, shell](Vec3 p) { return surface(p) + shell; }},
                          {anatomy->tissues[0].id, way.aim.bone * anatomy->tissues[0].density, {}}};
    const auto axis = std::find_if(anatomy->axes.begin(), anatomy->axes.end(),
                                   [](const documents::LandmarkAxis& one) { return one.id == "right_pedicle"; });
    KERF_ASSERT(axis != anatomy->axes.end(), "the anatomy names the right pedicle");
    scene.along = normalized(axis->to - axis->from);
    const Vec3 to_the_left{1, 0, 0};  // the canal lies to the left of the right pedicle
    const Vec3 sideways = normalized(to_the_left - dot(to_the_left, scene.along) * scene.along);
    scene.entry = axis->from + way.medial * sideways;
    while (scene.bone.surface(scene.entry) > 1.0_um)
        scene.entry = scene.entry + std::max<double>(1.0_um, 0.5 * scene.bone.surface(scene.entry)) * scene.along;
    scene.along = std::cos(way.aim.towards_canal) * scene.along + std::sin(way.aim.towards_canal) * sideways;
    scene.depth = {-1.5_mm};
    go_to(scene, 30.0_mm, scene.feed);
    // As much of the vertebra as the drill can reach.
    const double room = scene.drill.radius() + 1.0_mm;
    const Vec3 ends[] = {scene.entry - 2.0_mm * scene.along, scene.entry + 30.5_mm * scene.along};
    scene.bone.low = {std::min(ends[0].x, ends[1].x) - room, std::min(ends[0].y, ends[1].y) - room,
                      std::min(ends[0].z, ends[1].z) - room};
    scene.bone.high = {std::max(ends[0].x, ends[1].x) + room, std::max(ends[0].y, ends[1].y) + room,
                       std::max(ends[0].z, ends[1].z) + room};
    return scene;
}

}  // namespace

Scene pedicle_scene(double medial) {
    Scene scene = scene_on({.medial = medial});
    scene.id = medial == 0.0 ? "pedicle" : "pedicle-breach";
    scene.title = std::string("Pedicle of L4, a phantom, 3.2 mm drill, ") +
                  (medial == 0.0 ? "along the planned axis" : drawing::figure(1e3 * medial) + " mm towards the canal");
    return scene;
}

Scene pedicle_awl_scene(const AwlAim& aim) { return scene_on({.aim = aim}); }

}  // namespace kerf::chart
