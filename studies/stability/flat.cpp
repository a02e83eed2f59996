// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include <algorithm>
#include <cmath>
#include <string>

#include "studies/scenes/bone_block.h"
#include "studies/stability/scenes.h"
#include "studies/stability/touch_probe.h"

namespace kerf::stability {

namespace {

/// The force [N] on a hand that has laid the probe down and holds it `depth` below the face.
double laid_flat(const Body& body, const ToolSetup& probe, const CouplingGains& gains, double depth, bool is_direct) {
    const auto lying = [](double height) {
        return Pose{{0.5 * probe_length, 0.0, height}, quat_between({0, 0, 1}, {1, 0, 0})};
    };
    constexpr double above = 1e-3, speed = 5e-3;  // more than the probe is thick
    constexpr int ticks = 4000;
    ToolOutline outline;
    std::string error;
    if (!outline_of(probe, outline, error)) return std::nan("");
    Simulation simulation(body, probe, outline, gains, lying(above));
    double force = 0.0;
    for (int i = 0; i < ticks; ++i) {
        const DeviceSample sample{lying(std::max(-depth, above - speed * Simulation::dt * i))};
        force = (is_direct ? simulation.tick_direct(sample) : simulation.tick(sample)).command.wrench[2];
    }
    return force;
}

}  // namespace

void check_flat(const Scope& scope, const Report& report) {
    constexpr int few = 8, many = 16;
    const Body body = make({.thickness = 20e-3, .spacing = 1e-3, .width = 80e-3});
    for (const DeviceRecord& device : scope.devices) {
        const CouplingGains gains = in_hands(gains_for(device, 1.0));
        constexpr double depth = 1e-3;
        Finding finding{.test = "S-07", .hand = led};
        finding.device = device.id;
        finding.scene = "probe laid flat, points doubled";
        finding.criterion =
            "changes < 5 %, <= " + figure(device.peak_force, "N") + ", <= " + figure(device.largest_stiffness, "N/m");
        for (const bool is_direct : {true, false}) {
            // As printed a point's stiffness is what makes the wall; solved it may be as hard as bone.
            const double each = is_direct ? gains.stiffness / few : rigid;
            const double once = laid_flat(body, touch_probe(few, each), gains, depth, is_direct);
            const double twice = laid_flat(body, touch_probe(many, each), gains, depth, is_direct);
            const double change = twice / once - 1.0, stiffness = twice / depth;
            finding.method = is_direct ? Method::as_printed : Method::kerf;
            finding.measured = figure(once, "N") + " -> " + figure(twice, "N") + ", " + figure(100.0 * change, "%") +
                               ", " + figure(stiffness, "N/m");
            finding.outcome =
                passes(std::abs(change) < 0.05 && twice <= device.peak_force && stiffness <= device.largest_stiffness);
            report(finding);
        }
        finding.scene = "the plugin's tool laid flat, doubled";
        finding.measured = "";
        finding.criterion = "changes < 5 %";
        finding.outcome = Outcome::not_applicable;
        finding.reason = "how many points touch is the plugin's own and no parameter of it";
        report(finding);
    }
}

}  // namespace kerf::stability
