// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/kerf_run.h"

#include <algorithm>
#include <string>

#include "core/haptics/loop/work_force.h"
#include "kerf/assert.hpp"
#include "studies/stability/tool_under_test.h"
#include "studies/times.h"

namespace kerf::chart {

namespace {

ToolOutline outline(const ToolSetup& setup) {
    ToolOutline out;
    std::string error;
    const bool is_made = outline_of(setup, out, error);
    KERF_ASSERT(is_made, "a tool of a scene can be made");
    return out;
}

/// Scaled so that a push which the device can hold feeds the tool as the scene does, or as a procedure says.
CouplingGains gains(const Setting& setting, const Body& body) {
    const DeviceRecord& device = *find_device("premium-1.5-6dof");
    if (setting.working_force > 0.0) return in_hands(gains_for(device, force_scale_for(device, setting.working_force)));
    const double at_feed = work_force(setting.setup, body, setting.feed);
    return gains_for(device, std::min(1.0, stability::push_of(device) / at_feed));
}

}  // namespace

KerfRun::KerfRun(const Setting& setting, const Fineness& fineness, Way way)
    : body_(body_of(setting.bone, fineness.spacing, fineness.offset)),
      way_(way),
      simulation_(body_, setting.setup, outline(setting.setup), gains(setting, body_), setting.start) {}

Felt KerfRun::tick(const Pose& next) {
    Felt felt;
    felt.from = simulation_.world_from_tool();
    TickResult result;
    felt.cost = processor_time_of([&] {
        HapticLoop& loop = simulation_.loop();
        result = way_ == Way::direct ? loop.tick_direct({next}) : loop.tick({next});
    });
    simulation_.follow();
    felt.rate = result.rate;
    felt.commanded = -dot(linear(result.command.wrench), rotate(next.rotation, {0, 0, 1}));
    const Quat tool_from_world = conjugate(felt.from.rotation);
    felt.wrench = make_vec6(rotate(tool_from_world, linear(result.bone_on_tool)),
                            rotate(tool_from_world, angular(result.bone_on_tool)));
    return felt;
}

double KerfRun::removed_volume() {
    simulation_.finish();
    return simulation_.present().removed();
}

}  // namespace kerf::chart
