// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include <algorithm>
#include <cmath>
#include <vector>

#include "conformance/stability/bone_block.h"
#include "conformance/stability/kerf_loop.h"
#include "conformance/stability/scenes.h"

namespace kerf::stability {

namespace {

struct Drilled {
    std::vector<double> thrust, torque;  ///< every 10 ms [N, N·m]
    double removed = 0.0;                ///< [m³]
};

/// The same way at the same speed, with ticks of another length: led, and the law rendered as it is or solved.
Drilled drill(const ToolUnderTest& tool, const CouplingGains& gains, double period, KerfLoop::Way way) {
    constexpr double above = -0.5e-3, feed = 2e-3, seconds = 2.0, each = 10e-3;
    const Body body = make({.thickness = 8e-3});
    KerfLoop loop(body, tool.setup, gains, above, way, 0.0, period);
    loop.wait(above, static_cast<int>(std::lround(run_up * Simulation::dt / period)));
    Drilled drilled;
    const int every = static_cast<int>(std::lround(each / period)), ticks = static_cast<int>(std::lround(seconds / period));
    for (int i = 1; i <= ticks; ++i) {
        (void)loop.answer(above + feed * period * i);
        if (i % every != 0) continue;
        drilled.thrust.push_back(loop.last().thrust);
        drilled.torque.push_back(loop.last().torque);
    }
    loop.simulation().finish();
    drilled.removed = loop.simulation().present().removed();
    return drilled;
}

/// RMS of the difference, of the RMS of the first [–].
double apart(const std::vector<double>& a, const std::vector<double>& b) {
    double difference = 0.0, whole = 0.0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        difference += (a[i] - b[i]) * (a[i] - b[i]);
        whole += a[i] * a[i];
    }
    return std::sqrt(difference / whole);
}

}  // namespace

void look_at_loop_rate(const Scope& scope, const ToolUnderTest& tool, const Report& report) {
    const Body body = make({.thickness = 8e-3});
    const DeviceRecord& device = scope.devices.front();
    const CouplingGains gains = gains_under_push(device, push_of(device), tool, body);
    for (const auto way : {KerfLoop::Way::direct, KerfLoop::Way::solved}) {
        const Drilled at_1_khz = drill(tool, gains, 1e-3, way);
        for (const double period : {2e-3, 0.5e-3, 0.25e-3}) {
            const Drilled other = drill(tool, gains, period, way);
            const double thrust = apart(at_1_khz.thrust, other.thrust), torque = apart(at_1_khz.torque, other.torque);
            const double removed = other.removed / at_1_khz.removed - 1.0;
            Finding finding{.test = "P-05",
                            .scene = way == KerfLoop::Way::direct ? "loop rate, prescribed feed" : "loop rate, solved",
                            .hand = led};
            finding.device = device.id;
            finding.measured = figure(1.0 / period, "Hz") + ": thrust " + figure(100.0 * thrust, "%") + ", torque " +
                               figure(100.0 * torque, "%") + ", bone taken " + figure(100.0 * removed, "%") +
                               " off 1000 Hz";
            finding.criterion = "each within 2 %";
            finding.outcome = passes(thrust <= 0.02 && torque <= 0.02 && std::abs(removed) <= 0.02);
            report(finding);
        }
    }
}

}  // namespace kerf::stability
