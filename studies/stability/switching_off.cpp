// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "studies/scenes/bone_block.h"
#include "studies/stability/kerf_loop.h"
#include "studies/stability/port_tick.h"
#include "studies/stability/scenes.h"
#include "studies/stability/unreleased.h"

namespace kerf::stability {

namespace {

struct SwitchedOff {
    double step = 0.0;       ///< [N] the largest of the bone's force in a tick, as the device would be sent it
    int handing_over = 0;    ///< [ms] until contact carries what the edges carried last, within 7 % of the push
    double stands_on = 0.0;  ///< [N]
    bool is_finite = true, has_stopped = false;
};

SwitchedOff switch_off(const Body& body, const ToolUnderTest& tool, const PortSettings& settings,
                       const CouplingGains& gains, double push, KerfLoop::Rendering rendering) {
    constexpr double above = -0.5e-3, drilled = 2.5e-3;          // [m]
    constexpr int longest = 6000, after = 4000, looked_at = 50;  // [ticks]
    Port port(settings, above);
    port.go_along(true);
    KerfLoop loop(body, tool.setup, gains, above, rendering);
    loop.wait(port.reported(), run_up);
    for (int i = 0; i < longest && loop.tip() < drilled; ++i) tick(port, loop, push);
    for (std::size_t drive = 0; drive < tool.setup.drives.size(); ++drive) loop.simulation().command_drive(drive, 0.0);

    SwitchedOff off;
    std::vector<double> thrust{loop.last().thrust * gains.force_scale};
    std::size_t contact = 1;  // the first tick without a cut
    for (int i = 0; i < after; ++i) {
        tick(port, loop, push);
        thrust.push_back(loop.last().thrust * gains.force_scale);
        off.step = std::max(off.step, std::abs(thrust.back() - thrust[thrust.size() - 2]));
        off.is_finite = off.is_finite && std::isfinite(thrust.back()) && std::isfinite(loop.last().command.wrench[2]);
        if (loop.last().is_cutting) contact = thrust.size();
    }
    off.has_stopped = contact + looked_at < thrust.size();
    off.stands_on = thrust.back();
    for (int i = 0; off.has_stopped && i < looked_at; ++i)
        if (std::abs(thrust[contact + static_cast<std::size_t>(i)] - thrust[contact - 1]) > 0.07 * push)
            off.handing_over = i + 1;
    return off;
}

std::string in_figures(const SwitchedOff& off, double push) {
    return "largest step " + figure(100.0 * off.step / push, "%") + ", handed over in " +
           std::to_string(off.handing_over) + " ms, rests on " + figure(off.stands_on, "N");
}

}  // namespace

void check_switching_off(const Scope& scope, const ToolUnderTest& tool, const Report& report) {
    const Body body = make({.thickness = 16e-3});
    at_every_port(scope, [&](const DeviceRecord& device, const PortSettings& settings) {
        Finding finding{.test = "S-19", .scene = "switched off under a push"};
        finding.device = device.id;
        finding.hand = settings.hand.id;
        finding.delay = settings.delay;
        finding.criterion = "finite, steps <= 7 %, handed over in <= 10 ms";
        if (tool.setup.drives.empty()) {
            finding.reason = "the tool has no drive";
            report(finding);
            return;
        }
        const double push = push_of(device);
        const CouplingGains gains = gains_under_push(device, push, tool, body, settings.delay);
        for (const auto rendering : {KerfLoop::Rendering::direct, KerfLoop::Rendering::solved}) {
            const SwitchedOff off = switch_off(body, tool, settings, gains, push, rendering);
            const bool does_stand = std::abs(off.stands_on - push) < 0.07 * push + settings.friction;
            finding.method = rendering == KerfLoop::Rendering::solved ? Method::kerf : Method::as_printed;
            finding.measured = in_figures(off, push);
            finding.outcome = passes(off.is_finite && off.has_stopped && off.step <= 0.07 * push &&
                                     off.handing_over <= 10 && does_stand);
            if (rendering == KerfLoop::Rendering::solved && finding.outcome == Outcome::fail)
                finding.reason = without_release +
                                 in_figures(switch_off(body, tool, settings, unreleased(gains), push, rendering), push);
            report(finding);
        }
    });
}

}  // namespace kerf::stability
