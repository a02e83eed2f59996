// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "studies/scenes/bone_block.h"
#include "studies/stability/kerf_loop.h"
#include "studies/stability/scenes.h"
#include "studies/stability/touch_probe.h"

namespace kerf::stability {

namespace {

struct Impact {
    double energy = 0.0;  ///< [–] of motion, the most there is after touching, of what there was
    double force = 0.0;   ///< [N] the largest
};

/// A bare device falls on a face with a probe that touches at so many points: flat, or with its one point first, which
/// lying would tip over.
Impact fall(const Body& body, const PortSettings& settings, int points, double stiffness, const CouplingGains& gains,
            bool is_direct) {
    constexpr double above = 0.2e-3, speed = 0.05;  // [m] [m/s]
    constexpr int ticks = 400;
    const ToolSetup probe = touch_probe(points, stiffness);
    const auto lying = [&](double depth) {
        return points == 1 ? at_depth(depth)
                           : Pose{{0.5 * probe_length, 0.0, -depth}, quat_between({0, 0, 1}, {1, 0, 0})};
    };
    ToolOutline outline;
    std::string error;
    if (!outline_of(probe, outline, error)) return {};
    Port port(settings, -above);
    port.place(-above, speed);
    Simulation simulation(body, probe, outline, gains, lying(-1e-3));
    for (int i = 0; i < 20; ++i) {  // down to where the fall begins
        (void)simulation.tick({lying(-1e-3 + (1e-3 - above) * (i + 1) / 20.0)});
    }
    Impact impact;
    bool has_touched = false;
    for (int i = 0; i < ticks; ++i) {
        const DeviceSample sample{lying(port.reported())};
        const double force = (is_direct ? simulation.tick_direct(sample) : simulation.tick(sample)).command.wrench[2];
        impact.force = std::max(impact.force, force);
        has_touched = has_touched || force > 0.05;
        port.step(force, 0.0);
        if (has_touched && port.rate() < 0.0)
            impact.energy = std::max(impact.energy, port.rate() * port.rate() / (speed * speed));
    }
    return impact;
}

}  // namespace

void check_many_contacts(const Scope& scope, const Report& report) {
    const Body body = make({.thickness = 20e-3, .spacing = 1e-3, .width = 80e-3});
    for (const DeviceRecord& device : scope.devices)
        for (const bool is_direct : {true, false}) {
            const CouplingGains gains = in_hands(gains_for(device, 1.0));
            PortSettings settings = port_of(device, no_hand, 0);
            settings.friction = 0.0;  // nothing but the contact takes energy
            double max_energy = 0.0, min_force = 1e300, max_force = 0.0;
            for (const int points : {1, 10, 86, 110, 1000}) {
                const double each = is_direct ? gains.stiffness / 8.0 : rigid;
                const Impact impact = fall(body, settings, points, each, gains, is_direct);
                max_energy = std::max(max_energy, impact.energy);
                min_force = std::min(min_force, impact.force);
                max_force = std::max(max_force, impact.force);
            }
            const double spread = max_force / min_force - 1.0;
            Finding finding{.test = "S-17", .scene = "1 to 1000 points meet a plane at once"};
            finding.method = is_direct ? Method::as_printed : Method::kerf;
            finding.device = device.id;
            finding.measured = "energy after " + figure(100.0 * max_energy, "%") + ", force " + figure(min_force, "N") +
                               " ... " + figure(max_force, "N");
            finding.criterion = "energy <= 100 %, forces within 5 %";
            finding.outcome = passes(max_energy <= 1.0 && spread < 0.05);
            report(finding);
        }
}

}  // namespace kerf::stability
