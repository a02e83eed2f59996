// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "app/window/camera.h"
#include "run/view/viewed_run.h"

/// Where the camera begins.
namespace kerf::window {

struct Sphere {
    Vec3 middle{};
    double radius = 0.05;  ///< [m]
};

/// Returns a sphere around the bone, world frame; nothing if there is no surface.   [any] pure
[[nodiscard]] std::optional<Sphere> sphere_around(const run::ViewedSurface& surface, const run::ViewedState& state);

/// Turns the camera to a view of a step: '1' of the whole bone, '2' along the tool, '3' from the side of the tool.
void see_step(Camera& camera, char view, const run::ViewedStep& step, const Sphere& bone);

}  // namespace kerf::window
