// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "kerf/units.hpp"
#include "studies/scenes/bone_block.h"
#include "studies/stability/kerf_loop.h"
#include "studies/stability/scenes.h"
#include "studies/stability/touch_probe.h"

namespace kerf::stability {

namespace {

constexpr double shell = 0.5e-3, fast = 1.0;  // [m], [m/s]: two shells a tick

/// How many of `passes`, each from a phase of its own within a tick's way, feel nothing on their way through.
int unfelt(const Body& body, const CouplingGains& gains, int passes, KerfLoop::Rendering way) {
    std::uint32_t random = 4;
    int missed = 0;
    for (int n = 0; n < passes; ++n) {
        random = random * 1664525u + 1013904223u;
        const double step = fast * Simulation::dt, phase = static_cast<double>(random >> 8) / 16777216.0;
        double depth = -(4.0 + phase) * step;
        KerfLoop loop(body, touch_probe(1, rigid), gains, depth, way);
        bool is_felt = false;
        for (int i = 0; i < 9; ++i) {
            depth += step;
            is_felt = is_felt || std::abs(loop.answer(depth)) > 0.05;
        }
        missed += !is_felt;
    }
    return missed;
}

/// Bone that a drill led through the shell takes, of what it sweeps [–], by a hand that goes on until the drill is
/// through; nothing where it never is.
double taken(const ToolUnderTest& tool, const CouplingGains& gains, KerfLoop::Rendering way) {
    constexpr double start = -5e-3;
    constexpr int longest = 2000;  // [ticks]
    const double through = shell + tool.full_depth + 2e-3;
    const Body body = make({.thickness = shell, .spacing = 0.1e-3});
    KerfLoop loop(body, tool.setup, gains, start, way);
    loop.wait(start, run_up);
    double depth = start;
    for (int i = 0; i < longest && loop.tip() < through; ++i, depth += fast * Simulation::dt) (void)loop.answer(depth);
    loop.simulation().finish();
    return loop.tip() < through ? 0.0
                                : loop.simulation().present().removed() / (pi * tool.radius * tool.radius * shell);
}

}  // namespace

void check_tunnelling(const Scope& scope, const ToolUnderTest& tool, const Report& report) {
    const int times = scope.is_quick ? 100 : 1000;
    const Body body = make({.thickness = shell, .spacing = 0.1e-3, .width = 2e-3});
    for (const DeviceRecord& device : scope.devices) {
        const CouplingGains gains = in_hands(gains_for(device, 1.0));
        Finding finding{.test = "S-04", .scene = "0.5 mm shell at 1 m/s", .hand = led};
        finding.device = device.id;
        finding.criterion = "contact felt every time";
        for (const auto way : {KerfLoop::Rendering::direct, KerfLoop::Rendering::solved}) {
            const int missed = unfelt(body, gains, times, way);
            finding.method = way == KerfLoop::Rendering::solved ? Method::kerf : Method::as_printed;
            finding.measured = std::to_string(missed) + " of " + std::to_string(times) + " passes feel nothing";
            finding.outcome = passes(missed == 0);
            report(finding);
        }
    }
    Finding finding{.test = "S-04", .scene = "0.5 mm shell at 1 m/s: bone taken", .hand = led};
    finding.device = scope.devices.front().id;
    ToolOutline outline;
    std::string error;
    if (outline_of(tool.setup, outline, error) && outline.cutting.is_prism()) {
        finding.reason =
            "what is swept is known of a tool that turns; a blade is not led through a plate by its whole height";
        report(finding);
        return;
    }
    const CouplingGains gains = gains_under_push(scope.devices.front(), push_of(scope.devices.front()), tool, body);
    for (const auto way : {KerfLoop::Rendering::direct, KerfLoop::Rendering::solved}) {
        const double share = taken(tool, gains, way);
        finding.method = way == KerfLoop::Rendering::solved ? Method::kerf : Method::as_printed;
        finding.measured = figure(100.0 * (share - 1.0), "%") + " off what was swept";
        finding.criterion = "within 1 %";
        finding.outcome = passes(std::abs(share - 1.0) <= 0.01);
        finding.reason = way == KerfLoop::Rendering::solved ? "" : "at the device's rate, with Kerf's removal";
        report(finding);
    }
}

}  // namespace kerf::stability
