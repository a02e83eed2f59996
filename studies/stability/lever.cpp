// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include <algorithm>
#include <cmath>
#include <string>

#include "kerf/units.hpp"
#include "studies/stability/bone_block.h"
#include "studies/stability/scenes.h"
#include "studies/stability/touch_probe.h"

namespace kerf::stability {

namespace {

/// The probe lies over the face; a hand at its end turns the tip into the bone, moves aside, turns it out.
Pose lever(double tilt, double shift) {
    const Vec3 along{std::cos(tilt), 0.0, -std::sin(tilt)};
    const Vec3 tip{shift + probe_length * (std::cos(tilt) - 1.0), 0.0, 0.3e-3 - probe_length * std::sin(tilt)};
    return {tip, quat_between({0, 0, 1}, along)};
}

struct Levered {
    double work = 0.0, moved = 0.0;  ///< [J] given to the hand, and to it and from it
    double most = 0.0;               ///< [N]
};

/// A wall that is a spring as stiff as the coupling, against the tip of a probe that is held at `grip`: what the device
/// makes of it there.
Vec6 penalty(const Pose& probe, Vec3 grip, const CouplingGains& gains) {
    const Vec3 force{0.0, 0.0, std::clamp(-gains.stiffness * probe.position.z, 0.0, gains.force_limit)};
    return make_vec6(force, clamped(cross(probe.position - probe * grip, force), gains.torque_limit));
}

Levered lever_with(Method method, const Body& body, const CouplingGains& gains) {
    constexpr int cycles = 10, ticks = 400;
    const ToolSetup probe = touch_probe(1, 5e5);
    ToolOutline outline;
    std::string error;
    if (!outline_of(probe, outline, error)) return {};
    Simulation simulation(body, probe, outline, gains, lever(0.0, 0.0));
    const Vec3 grip{0.0, 0.0, outline.grip_z};
    Levered levered;
    Pose last = lever(0.0, 0.0);
    Vec6 wrench{};
    for (int i = 0; i < cycles * ticks; ++i) {
        const double phase = 2.0 * pi * (i % ticks) / ticks;
        const Pose now = lever(0.05 * (1.0 - std::cos(phase)), 1e-3 * std::sin(phase));
        double given = dot(linear(wrench), now * grip - last * grip);
        if (gains.has_torque)
            given += dot(angular(wrench),
                         rotate(last.rotation, small_rotation_vector(conjugate(last.rotation) * now.rotation)));
        levered.work += given;
        levered.moved += std::abs(given);
        last = now;
        if (method == Method::as_printed) {
            wrench = penalty(now, grip, gains);
        } else {
            wrench = simulation.tick({now}).command.wrench;
            simulation.after_tick();
        }
        levered.most = std::max(levered.most, length(linear(wrench)));
    }
    return levered;
}

}  // namespace

void look_at_lever(const Scope& scope, const Report& report) {
    const Body body = make({.thickness = 8e-3});
    for (const DeviceRecord& device : scope.devices)
        for (const Method method : {Method::as_printed, Method::kerf}) {
            const CouplingGains gains = gains_for(device, 1.0);
            const Levered levered = lever_with(method, body, gains);
            Finding finding{.test = "A-09", .scene = "lever, ten cycles", .hand = led};
            finding.method = method;
            finding.device = device.id;
            finding.measured = figure(1e3 * levered.work, "mJ") + " on the hand, of " +
                               figure(1e3 * levered.moved, "mJ") + " to and fro, at most " + figure(levered.most, "N");
            finding.criterion = "<= 1 mJ";
            finding.outcome = passes(levered.work <= 1e-3 && levered.most > 0.0);
            if (!gains.has_torque)
                finding.reason = "what it gives comes from turning, which this device does not resist";
            report(finding);
        }
}

}  // namespace kerf::stability
