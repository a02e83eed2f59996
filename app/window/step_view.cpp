// SPDX-License-Identifier: Apache-2.0
#include "app/window/step_view.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace kerf::window {

std::optional<Sphere> sphere_around(const run::ViewedSurface& surface, const run::ViewedState& state) {
    Vec3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (std::size_t body = 0; body < std::min<std::size_t>(surface.bodies.size(), state.body_count); ++body)
        for (std::size_t brick = 0; brick < surface.bodies[body].patches.capacity(); ++brick) {
            const auto& patch = surface.bodies[body].patches[brick];
            if (patch == nullptr || patch->vertices.empty()) continue;
            const float* p = patch->vertices.front().position;
            const Vec3 at = state.bodies[body].world_from_body * Vec3{p[0], p[1], p[2]};
            low = {std::min(low.x, at.x), std::min(low.y, at.y), std::min(low.z, at.z)};
            high = {std::max(high.x, at.x), std::max(high.y, at.y), std::max(high.z, at.z)};
        }
    if (low.x > high.x) return std::nullopt;
    return Sphere{0.5 * (low + high), 0.5 * length(high - low)};
}

void see_step(Camera& camera, char view, const run::ViewedStep& step, const Sphere& bone) {
    const Vec3 head{0, 0, 1};
    Vec3 aside = cross(step.along, head);
    aside = length(aside) > 1e-3 ? normalized(aside) : Vec3{1, 0, 0};
    const Vec3 over = cross(aside, step.along);
    const Vec3 target = step.entry + 0.15 * (bone.middle - step.entry);
    if (view == '1')
        camera.see(bone.middle, 1.05 * bone.radius, -1.0 * step.along + 0.9 * aside + 0.5 * over, head);
    else if (view == '2')
        camera.see(step.entry, 0.45 * bone.radius, -1.0 * step.along, over);
    else
        camera.see(target, 0.72 * bone.radius, -1.0 * step.along + 1.15 * aside + 0.75 * over, head);
}

}  // namespace kerf::window
