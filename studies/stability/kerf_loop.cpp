// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/stability/kerf_loop.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

#include "kerf/assert.hpp"

namespace kerf::stability {

namespace {

Vec3 along(double tilt) { return {std::sin(tilt), 0.0, -std::cos(tilt)}; }

ToolOutline outline(const ToolSetup& setup) {
    ToolOutline out;
    std::string error;
    const bool is_made = outline_of(setup, out, error);
    KERF_ASSERT(is_made, "ask outline_of() before a loop is made");
    return out;
}

}  // namespace

Pose at_depth(double depth, double tilt) { return {depth * along(tilt), quat_between({0, 0, 1}, along(tilt))}; }

KerfLoop::KerfLoop(const Body& body, const ToolSetup& setup, const CouplingGains& gains, double depth,
                   Rendering rendering, double tilt, double period)
    : rendering_(rendering),
      tilt_(tilt),
      simulation_(body, setup, outline(setup), gains, at_depth(depth, tilt), period) {}

Pose KerfLoop::handle_at(double depth) const noexcept {
    Pose pose = at_depth(depth, tilt_);
    if (turned_ != 0.0)
        pose.rotation =
            pose.rotation * quat_from_rotation_vector({0, 0, std::remainder(turned_, 2.0 * std::numbers::pi)});
    return pose;
}

double KerfLoop::answer(double depth, std::uint32_t missed) {
    const DeviceSample sample{handle_at(depth), missed};
    last_ = rendering_ == Rendering::solved ? simulation_.tick(sample) : simulation_.tick_direct(sample);
    return -dot(linear(last_.command.wrench), along(tilt_));
}

void KerfLoop::wait(double depth, int ticks) {
    for (int i = 0; i < ticks; ++i) (void)answer(depth);
}

double KerfLoop::stored(double depth) const noexcept {
    return rendering_ == Rendering::solved ? simulation_.stored_at(handle_at(depth)) : 0.0;
}

double KerfLoop::tip() const noexcept { return dot(simulation_.world_from_tool().position, along(tilt_)); }

}  // namespace kerf::stability
