// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "kerf/units.hpp"
#include "studies/scenes/bone_block.h"
#include "studies/stability/criterion.h"
#include "studies/stability/kerf_loop.h"
#include "studies/stability/scenes.h"
#include "studies/stability/touch_probe.h"

namespace kerf::stability {

namespace {

struct Stalled {
    double unheld = 0.0;   ///< [J] given with the force the device was left with, until that has faded
    double ramped = 0.0;   ///< [J] given from then on until force is given back
    double given = 0.0;    ///< [J] given from then on in all
    double rise = 0.0;     ///< [N] the largest within a millisecond while force is given back
    bool is_back = false;  ///< the loop took it for a fault, and holds the hand again
};

/// A hand presses harder and less hard on a wall, three times a second. As it lets go, and is carried off by the force
/// that the device was left with, or as it presses on, the loop misses ticks. As printed the wall is a spring as stiff
/// as the coupling, which knows nothing of them: its force is back, and counts, from the first tick on.
enum class Hand { lets_go, presses_on };
Stalled press_with_stall(const Body& body, const PortSettings& settings, const CouplingGains& gains, double push,
                         Hand hand, int missed, Method method) {
    const bool is_solved = method == Method::kerf;
    constexpr double above = -0.1e-3, hertz = 3.0;
    const int stall_from = hand == Hand::lets_go ? 500 : 667,
              ticks = stall_from + 600;  // where the push falls, or rises, fastest
    const int back = stall_from + missed;
    const int faded = is_solved ? back + 5 + settings.delay : back;
    int given_back = faded + 50;  // at the earliest
    Port port(settings, above);
    KerfLoop loop(body, touch_probe(1, rigid), gains, above);
    const auto answer = [&](double depth, int missed_before) {
        return is_solved ? loop.answer(depth, static_cast<std::uint32_t>(missed_before))
                         : std::clamp(gains.stiffness * depth, 0.0, gains.force_limit);
    };
    const auto stored = [&](double depth) {
        const double pressed = std::max(0.0, depth);
        return is_solved ? loop.stored(depth) : 0.5 * gains.stiffness * pressed * pressed;
    };
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
            port.step(answer(port.reported(), i == back ? missed : 0), now);
        energy.see(port.held(), port.depth() - before, stored(port.depth()));
        has_faulted = has_faulted || loop.last().is_closed_or_closing;
        if (loop.last().is_coming_back)
            given_back = std::max(given_back, i + settings.delay + 3);  // the step it ends with included
        if (i >= faded && i < given_back) {
            stalled.rise = std::max(stalled.rise, port.held() - last);
            stalled.ramped = at_fade - energy.least();
        }
        last = port.held();
        if (i == faded - 1) {
            stalled.unheld = -energy.least();
            at_fade = std::min(0.0, energy.now());
            energy.begin();
        }
    }
    stalled.ramped = std::max(0.0, stalled.ramped);
    stalled.given = std::max(0.0, at_fade - energy.least());
    stalled.is_back = !is_solved || (has_faulted && !loop.last().is_closed_or_closing);
    return stalled;
}

}  // namespace

void check_missed_ticks(const Scope& scope, const Report& report) {
    const Body body = make({.thickness = 8e-3});
    at_every_port(scope, [&](const DeviceRecord& device, const PortSettings& settings) {
        const double push = std::min(2.0, 0.5 * device.peak_force);
        const CouplingGains gains = in_hands(gains_for(device, 1.0, settings.delay));
        for (const Method method : {Method::as_printed, Method::kerf})
            for (const Hand hand : {Hand::lets_go, Hand::presses_on}) {
                const Stalled never = press_with_stall(body, settings, gains, push, hand, 0, method);
                for (const int missed : {5, 20, 100}) {
                    const Stalled stalled = press_with_stall(body, settings, gains, push, hand, missed, method);
                    Finding finding{
                        .test = "S-21",
                        .scene = std::to_string(missed) + (hand == Hand::lets_go ? " ticks missed, letting go of a wall"
                                                                                 : " ticks missed, pressing on")};
                    finding.method = method;
                    finding.device = device.id;
                    finding.hand = settings.hand.id;
                    finding.delay = settings.delay;
                    finding.measured = figure(1e3 * stalled.ramped, "mJ") + " ramped back, " +
                                       figure(1e3 * stalled.given, "mJ") + " given in all, rises by " +
                                       figure(stalled.rise, "N") + " (" + figure(never.rise, "N") +
                                       " with none missed)";
                    finding.criterion = std::string(method == Method::kerf ? "anchored again; then " : "") +
                                        "<= 0.1 mJ ramped back, < 1 mJ given, rises by <= 0.5 N/ms";
                    finding.outcome = passes(stalled.is_back && stalled.ramped <= 1e-4 && stalled.given < 1e-3 &&
                                             stalled.rise <= 0.5);
                    finding.reason = (method == Method::kerf ? "until its force has faded" : "until the loop is back") +
                                     std::string(" only the device can stop itself: it gave ") +
                                     figure(1e3 * stalled.unheld, "mJ");
                    report(finding);
                }
            }
    });
}

}  // namespace kerf::stability
