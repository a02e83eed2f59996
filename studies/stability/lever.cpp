// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include <algorithm>
#include <cmath>
#include <string>

#include "kerf/units.hpp"
#include "studies/scenes/bone_block.h"
#include "studies/stability/scenes.h"
#include "studies/stability/touch_probe.h"

namespace kerf::stability {

namespace {

constexpr int cycles = 10, ticks = 400;  // of a cycle

/// From 0 to 1 while `phase` goes through the quarter of a cycle that begins at `from`, smoothly.
double eased(double phase, double from) {
    const double part = std::clamp(4.0 * (phase - from), 0.0, 1.0);
    return 0.5 * (1.0 - std::cos(pi * part));
}

/// The probe lies over the face. A hand at its end turns the tip 0.1 rad into the bone, lets itself be moved 15 mm with
/// the force, turns the probe back, and returns: `phase` 0 … 1.
Pose lever(double phase) {
    const double tilt = 0.1 * (eased(phase, 0.0) - eased(phase, 0.5));
    const double lift = 15e-3 * (eased(phase, 0.25) - eased(phase, 0.75));
    const Vec3 along{std::cos(tilt), 0.0, -std::sin(tilt)};
    const Vec3 tip{probe_length * (std::cos(tilt) - 1.0), 0.0, 0.3e-3 + lift - probe_length * std::sin(tilt)};
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
    const ToolSetup probe = touch_probe(1, 5e5);
    ToolOutline outline;
    std::string error;
    if (!outline_of(probe, outline, error)) return {};
    Simulation simulation(body, probe, outline, gains, lever(0.0));
    const Vec3 grip{0.0, 0.0, outline.handling.grip_z};
    Levered levered;
    Pose last = lever(0.0);
    Vec6 wrench{};
    for (int i = 0; i < cycles * ticks; ++i) {
        const Pose now = lever(static_cast<double>(i % ticks) / ticks);
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
        }
        levered.most = std::max(levered.most, length(linear(wrench)));
    }
    return levered;
}

}  // namespace

void check_lever(const Scope& scope, const Report& report) {
    constexpr double most = 0.2e-3;  // [J] a cycle
    const Body body = make({.thickness = 8e-3});
    for (const DeviceRecord& device : scope.devices)
        for (const double scale : {1.0, 0.01})
            for (const Method method : {Method::as_printed, Method::kerf}) {
                const CouplingGains gains = in_hands(gains_for(device, scale));
                const Levered levered = lever_with(method, body, gains);
                const double given = levered.work / cycles;
                Finding finding{.test = "A-09", .scene = "lever, a cycle at " + figure(scale, "x"), .hand = led};
                finding.method = method;
                finding.device = device.id;
                finding.measured = figure(1e3 * given, "mJ") + " on the hand, of " +
                                   figure(1e3 * levered.moved / cycles, "mJ") + " to and fro, at most " +
                                   figure(levered.most, "N");
                finding.criterion = "<= " + figure(1e3 * most, "mJ");
                finding.outcome = passes(given <= most && levered.most > 0.0);
                if (!gains.has_torque)
                    finding.reason = "what it gives comes from turning, which this device does not resist";
                report(finding);
            }
}

}  // namespace kerf::stability
