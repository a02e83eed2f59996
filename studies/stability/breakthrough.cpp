// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include <algorithm>
#include <cmath>
#include <string>

#include "kerf/units.hpp"
#include "studies/scenes/bone_block.h"
#include "studies/stability/kerf_loop.h"
#include "studies/stability/port_tick.h"
#include "studies/stability/scenes.h"

namespace kerf::stability {

namespace {

constexpr double shell = 1e-3, above = -0.5e-3;  // [m]
constexpr double felt = 0.05;                    // [N]

/// A hand that is let go by a force: how far it overshoots from rest.
///
///     x = F/K (1 + e^(−πζ/√(1−ζ²)))
double release(const PortSettings& settings, double force) {
    const double k = settings.hand.stiffness;
    const double zeta = settings.damping() / (2.0 * std::sqrt(k * settings.moved_mass()));
    return force / k * (1.0 + std::exp(-pi * zeta / std::sqrt(1.0 - zeta * zeta)));
}

struct Passage {
    bool has_cleared = false;
    int ticks_felt = -1;                ///< from clearing until the loop first asks for less than 0.05 N
    double later = 0.0, fastest = 0.0;  ///< [N] the most it asks for after that, and [m/s] of the hand until then
    double bound = 0.0;                 ///< [m/s] the loop's own: faster than that no tool follows a hand near bone
    double hand = 0.0, tool = 0.0, stretch = 0.0;  ///< [m] travels after clearing; the coupling's stretch at clearing
};

Passage pass_through(const PortSettings& settings, const Body& body, const ToolUnderTest& tool,
                     const CouplingGains& gains, double push, KerfLoop::Rendering way) {
    constexpr int longest = 6000, after = 600, settling = 20;  // [ticks]
    constexpr double free_way = 60e-3;                         // [m] a bare device is looked at
    Port port(settings, above);
    port.go_along(true);
    KerfLoop loop(body, tool.setup, gains, above, way);
    loop.wait(port.reported(), run_up);
    Passage passage;
    for (int i = 0; i < longest && loop.tip() < shell + tool.full_depth; ++i) tick(port, loop, push);
    passage.has_cleared = loop.tip() >= shell + tool.full_depth;
    if (!passage.has_cleared) return passage;
    // The hand has not noticed: it goes on pushing, and its arm stays where it was.
    port.go_along(false);
    port.aim_here();
    const double hand_at = port.depth(), tool_at = loop.tip();
    double fastest = 0.0;
    passage.bound = loop.simulation().fastest_near_bone();
    passage.stretch = hand_at - tool_at;
    for (int i = 0; i < after; ++i) {
        fastest = std::max(fastest, port.rate());
        const double force = tick(port, loop, push);
        if (passage.ticks_felt < 0 && std::abs(force) < felt) passage.ticks_felt = i;
        if (passage.ticks_felt >= 0 && std::abs(force) > passage.later) {
            passage.later = std::abs(force);
            passage.fastest = fastest;
        }
        passage.hand = std::max(passage.hand, port.depth() - hand_at);
        passage.tool = std::max(passage.tool, loop.tip() - tool_at);
        const bool has_turned =
            settings.hand.stiffness > 0.0 ? i > settling && port.rate() < 0.0 : passage.hand > free_way;
        if (has_turned) break;
    }
    return passage;
}

}  // namespace

void check_breakthrough(const Scope& scope, const ToolUnderTest& tool, const Report& report) {
    const Body body = make({.thickness = shell});
    at_every_port(scope, [&](const DeviceRecord& device, PortSettings settings) {
        settings.friction = 0.0;  // the formula has none
        const double push = push_of(device);
        const CouplingGains gains = gains_under_push(device, push, tool, body, settings.delay);
        for (const auto way : {KerfLoop::Rendering::direct, KerfLoop::Rendering::solved}) {
            const bool is_solved = way == KerfLoop::Rendering::solved;
            const Passage passage = pass_through(settings, body, tool, gains, push, way);
            Finding finding{.test = "S-15", .scene = "1 mm shell: force after clearing"};
            finding.method = is_solved ? Method::kerf : Method::as_printed;
            finding.device = device.id;
            finding.hand = settings.hand.id;
            finding.delay = settings.delay;
            const bool is_gone = passage.ticks_felt >= 0 && passage.ticks_felt <= 3;
            finding.measured = passage.has_cleared
                                   ? std::to_string(passage.ticks_felt) + " ticks; tool " +
                                         figure(1e3 * (passage.tool - passage.hand), "mm") +
                                         " further than the hand, stretch " + figure(1e3 * passage.stretch, "mm")
                                   : "never cleared";
            finding.criterion = "< 0.05 N within 3 ticks";
            finding.outcome = passes(passage.has_cleared && is_gone);
            report(finding);
            finding.scene = "1 mm shell: no rebound";
            finding.measured = figure(passage.later, "N") + " later at most, the hand until then at most " +
                               figure(passage.fastest, "m/s");
            finding.criterion = "< 0.05 N";
            finding.outcome = passes(passage.has_cleared && is_gone && passage.later < felt);
            if (is_solved && finding.outcome == Outcome::fail && passage.fastest > passage.bound) {
                finding.outcome = Outcome::not_applicable;
                finding.reason = "near bone a tool follows the hand at " + figure(passage.bound, "m/s") +
                                 " at most: half a voxel in each part of a tick";
            }
            report(finding);
            finding.reason = "";
            finding.scene = "1 mm shell: overtravel of the hand";
            if (settings.hand.stiffness <= 0.0) {
                finding.measured = finding.criterion = "";
                finding.outcome = Outcome::not_applicable;
                finding.reason = "without a hand nothing holds the handle back";
            } else {
                const double theory = release(settings, push);
                finding.measured =
                    figure(1e3 * passage.hand, "mm") + ", " + figure(100.0 * (passage.hand / theory - 1.0), "%");
                finding.criterion = figure(1e3 * theory, "mm") + " +- 10 %";
                finding.outcome = passes(passage.has_cleared && std::abs(passage.hand / theory - 1.0) <= 0.1);
            }
            report(finding);
        }
    });
}

}  // namespace kerf::stability
