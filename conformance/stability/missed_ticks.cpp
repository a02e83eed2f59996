// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include <algorithm>
#include <cmath>

#include "conformance/stability/bone_block.h"
#include "conformance/stability/criterion.h"
#include "conformance/stability/kerf_loop.h"
#include "conformance/stability/scenes.h"
#include "conformance/stability/touch_probe.h"
#include "conformance/stability/unreleased.h"
#include "kerf/units.hpp"

namespace kerf::stability {

namespace {

struct Stalled {
    double least_energy = 0.0;  ///< [J]
    double step = 0.0;          ///< [N] the largest within a millisecond, fault transitions left out
    bool has_faulted = false;
};

/// A hand presses harder and less hard on a wall, three times a second; as it lets go the loop misses ticks.
Stalled press_with_stall(const Body& body, const PortSettings& settings, const CouplingGains& gains, double push,
                         int missed) {
    constexpr double above = -0.1e-3, hertz = 3.0;
    constexpr int stall_from = 500, ticks = 1000;  // at half a second the push falls fastest
    Port port(settings, above);
    KerfLoop loop(body, touch_probe(1, rigid), gains, above);
    Stalled stalled;
    PortEnergy energy;
    double last = 0.0;
    for (int i = 0; i < ticks; ++i) {
        const double now = push * (1.0 + 0.5 * std::sin(2.0 * pi * hertz * Simulation::dt * i));
        const double before = port.depth();
        const bool is_missed = i >= stall_from && i < stall_from + missed;
        if (is_missed)
            port.step_unanswered(now);
        else
            port.step(loop.answer(port.reported(), i == stall_from + missed ? static_cast<std::uint32_t>(missed) : 0u), now);
        energy.see(port.held(), port.depth() - before, loop.stored(port.depth()));
        const bool is_fault = loop.last().is_barred;
        stalled.has_faulted = stalled.has_faulted || is_fault;
        if (i >= stall_from && !is_fault) stalled.step = std::max(stalled.step, std::abs(port.held() - last));
        last = port.held();
    }
    stalled.least_energy = energy.least();
    return stalled;
}

}  // namespace

void look_at_missed_ticks(const Scope& scope, const Report& report) {
    const Body body = make({.thickness = 8e-3});
    at_every_port(scope, [&](const DeviceRecord& device, const PortSettings& settings) {
        const double push = std::min(2.0, 0.5 * device.peak_force);
        const CouplingGains gains = gains_for(device, 1.0);
        const Stalled never = press_with_stall(body, settings, gains, push, 0);
        for (const int missed : {5, 20, 100}) {
            const Stalled stalled = press_with_stall(body, settings, gains, push, missed);
            const double injected = std::max(0.0, never.least_energy - stalled.least_energy);
            Finding finding{.test = "S-21", .scene = std::to_string(missed) + " ticks missed on a wall"};
            finding.device = device.id;
            finding.hand = settings.hand.id;
            finding.delay = settings.delay;
            finding.measured = figure(1e3 * injected, "mJ") + " injected, step " + figure(stalled.step, "N") + " (" +
                               figure(never.step, "N") + " with none missed)";
            finding.criterion = "< 1 mJ, <= 0.5 N/ms but for faults";
            finding.outcome = passes(injected < 1e-3 && stalled.step <= 0.5);
            if (finding.outcome == Outcome::fail) {
                const Stalled without = press_with_stall(body, settings, unreleased(gains), push, missed);
                finding.reason = std::string(without_release) + "step " + figure(without.step, "N");
            }
            if (stalled.has_faulted) finding.reason += "; the loop took it for a fault";
            report(finding);
        }
    });
}

}  // namespace kerf::stability
