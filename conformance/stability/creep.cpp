// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include <algorithm>
#include <cmath>
#include <vector>

#include "conformance/stability/bone_block.h"
#include "conformance/stability/kerf_loop.h"
#include "conformance/stability/scenes.h"
#include "kerf/units.hpp"

namespace kerf::stability {

namespace {

struct Way {
    const char* name;
    Vec3 along;
};

struct Crept {
    double mean = 0.0, step = 0.0, swing = 0.0;  ///< [N] thrust, its largest change in a tick, least to most
};

/// Into the bone at a usual feed, then on by a voxel at 0.01 mm/s: where points lie in the grid is all that changes.
Crept creep(const Body& body, const ToolUnderTest& tool, const CouplingGains& gains, Vec3 along, double way) {
    constexpr double usual = 2e-3, slow = 0.01e-3, above = -1e-3, settle = 5e-6;  // [m/s], [m]
    const Vec3 direction = normalized(along);
    const Quat turned = quat_between({0, 0, 1}, direction);
    const auto at = [&](double depth) { return Pose{depth * direction, turned}; };
    ToolOutline outline;
    std::string error;
    Crept crept;
    if (!outline_of(tool.setup, outline, error)) return crept;
    Simulation simulation(body, tool.setup, outline, gains, at(above));
    double depth = above;
    const auto go = [&](double speed) {
        depth += speed * Simulation::dt;
        const double thrust = simulation.tick_direct({at(depth)}).thrust;
        simulation.after_tick();
        return thrust;
    };
    for (int i = 0; i < run_up; ++i) (void)go(0.0);
    const double engaged = 1.5e-3 + (tool.full_depth + tool.radius * std::tan(std::acos(-direction.z))) / -direction.z;
    while (depth < engaged) (void)go(usual);
    for (const double until = depth + settle; depth < until;) (void)go(slow);
    std::vector<double> thrust;
    for (const double until = depth + way; depth < until;) thrust.push_back(go(slow));
    for (const double f : thrust) crept.mean += f / static_cast<double>(thrust.size());
    for (std::size_t i = 1; i < thrust.size(); ++i) crept.step = std::max(crept.step, std::abs(thrust[i] - thrust[i - 1]));
    const auto [low, high] = std::minmax_element(thrust.begin(), thrust.end());
    crept.swing = *high - *low;
    return crept;
}

}  // namespace

void look_at_creep(const Scope& scope, const ToolUnderTest& tool, const Report& report) {
    constexpr double spacing = 0.25e-3;
    const Body body = make({.thickness = 16e-3, .spacing = spacing, .width = 24e-3});
    const CouplingGains gains = gains_for(scope.devices.front(), 1.0);
    std::vector<Way> ways{{"along an edge of the grid", {0, 0, -1}}, {"across its cells", {1, 1, -1}}};
    if (!scope.is_quick) {
        ways.push_back({"across its faces", {1, 0, -1}});
        ways.push_back({"10 deg off an edge", {std::tan(10.0 * pi / 180.0), 0, -1}});
        ways.push_back({"askew", {0.2, 0.37, -1}});
    }
    for (const Way& way : ways) {
        const Crept crept = creep(body, tool, gains, way.along, spacing);
        Finding finding{.test = "S-05", .scene = "creep of 0.01 mm/s, prescribed", .hand = led};
        finding.measured = std::string(way.name) + ": step " + figure(100.0 * crept.step / crept.mean, "%") + " of " +
                           figure(crept.mean, "N") + ", " + figure(100.0 * crept.swing / crept.mean, "%") +
                           " from least to most";
        finding.criterion = "steps <= 1/31 of the force";
        finding.outcome = passes(crept.mean > 0.0 && crept.step <= crept.mean / 31.0);
        report(finding);
    }
}

}  // namespace kerf::stability
