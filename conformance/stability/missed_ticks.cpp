// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include <algorithm>
#include <cmath>

#include "conformance/stability/bone_block.h"
#include "conformance/stability/criterion.h"
#include "conformance/stability/kerf_loop.h"
#include "conformance/stability/scenes.h"
#include "conformance/stability/touch_probe.h"
#include "kerf/units.hpp"

namespace kerf::stability {

namespace {

struct Stalled {
    double unheld = 0.0;   ///< [J] given with the force the device was left with, until that has faded
    double given = 0.0;    ///< [J] given from then on
    double step = 0.0;     ///< [N] the largest within a millisecond while force is given back
    bool is_back = false;  ///< the loop took it for a fault, and holds the hand again
};

/// A hand presses harder and less hard on a wall, three times a second; as it lets go the loop misses ticks.
Stalled press_with_stall(const Body& body, const PortSettings& settings, const CouplingGains& gains, double push,
                         int missed) {
    constexpr double above = -0.1e-3, hertz = 3.0;
    constexpr int stall_from = 500, ticks = 1000;  // at half a second the push falls fastest
    const int back = stall_from + missed;
    const int faded = back + 5 + settings.delay;
    int given_back = faded + 50;  // at the earliest
    Port port(settings, above);
    KerfLoop loop(body, touch_probe(1, rigid), gains, above);
    Stalled stalled;
    PortEnergy energy;
    double last = 0.0, at_fade = 0.0;
    bool has_faulted = false;
    for (int i = 0; i < ticks; ++i) {
        const double now = push * (1.0 + 0.5 * std::sin(2.0 * pi * hertz * Simulation::dt * i));
        const double before = port.depth();
        if (i >= stall_from && i < back)
            port.step_unanswered(now);
        else
            port.step(loop.answer(port.reported(), i == back ? static_cast<std::uint32_t>(missed) : 0u), now);
        energy.see(port.held(), port.depth() - before, loop.stored(port.depth()));
        has_faulted = has_faulted || loop.last().is_barred;
        if (loop.last().is_coming_back) given_back = std::max(given_back, i + settings.delay + 3);  // the step it ends with included
        if (i >= faded && i < given_back) stalled.step = std::max(stalled.step, std::abs(port.held() - last));
        last = port.held();
        if (i == faded - 1) {
            stalled.unheld = -energy.least();
            at_fade = std::min(0.0, energy.now());
            energy.begin();
        }
    }
    stalled.given = std::max(0.0, at_fade - energy.least());
    stalled.is_back = has_faulted && !loop.last().is_barred;
    return stalled;
}

}  // namespace

void look_at_missed_ticks(const Scope& scope, const Report& report) {
    const Body body = make({.thickness = 8e-3});
    at_every_port(scope, [&](const DeviceRecord& device, const PortSettings& settings) {
        const double push = std::min(2.0, 0.5 * device.peak_force);
        const CouplingGains gains = gains_for(device, 1.0, settings.delay);
        const Stalled never = press_with_stall(body, settings, gains, push, 0);
        for (const int missed : {5, 20, 100}) {
            const Stalled stalled = press_with_stall(body, settings, gains, push, missed);
            Finding finding{.test = "S-21", .scene = std::to_string(missed) + " ticks missed on a wall"};
            finding.device = device.id;
            finding.hand = settings.hand.id;
            finding.delay = settings.delay;
            finding.measured = figure(1e3 * stalled.given, "mJ") + " ramped back, step " + figure(stalled.step, "N") +
                               " (" + figure(never.step, "N") + " with none missed)";
            finding.criterion = "anchored again; then <= 0.1 mJ given, <= 0.5 N/ms";
            finding.outcome = passes(stalled.is_back && stalled.given <= 1e-4 && stalled.step <= 0.5);
            finding.reason = "until its force has faded only the device can stop itself: it gave " +
                             figure(1e3 * stalled.unheld, "mJ");
            report(finding);
        }
    });
}

}  // namespace kerf::stability
