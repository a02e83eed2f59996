// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/stability/cutting.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "studies/scenes/bone_block.h"
#include "studies/stability/bracket.h"
#include "studies/stability/kerf_loop.h"
#include "studies/stability/press.h"
#include "studies/stability/unreleased.h"

namespace kerf::stability {

namespace {

constexpr double above_face = -0.5e-3;            // [m]
constexpr double thickness = 16e-3;               // [m] of the block: four times what the push is to feed
constexpr int pushing = 2000;                     // [ticks]
constexpr double min_gain = 1e2, max_gain = 1e5;  // [N·s/m] of bone, what published laws span

bool alternates(const PortSettings& settings, double gain, double push) {
    constexpr int ticks = 2000, looked_at = 200;
    Port port(settings, 0.0);
    port.go_along(true);
    double last = port.reported();
    const Trace trace = press(
        port,
        [&](double depth) {
            const double rate = (depth - last) / settings.period;
            last = depth;
            return std::max(0.0, gain * rate);
        },
        ticks, push);
    for (std::size_t i = ticks - looked_at; i < ticks; ++i)
        if (std::abs(trace.force[i] - 2.0 * trace.force[i - 1] + trace.force[i - 2]) > 1e-3 * push) return true;
    return false;
}

Finding place_of(const DeviceRecord& device, const PortSettings& settings) {
    Finding finding{.test = "S-01"};
    finding.device = device.id;
    finding.hand = settings.hand.id;
    finding.delay = settings.delay;
    return finding;
}

struct Pushed {
    Judged judged;                     ///< while it was in the block
    double tip = 0.0;                  ///< [m] deep
    std::size_t left_after = pushing;  ///< [ticks] it was through the block, or back out of it by a millimetre

    [[nodiscard]] bool has_left() const noexcept { return left_after < pushing; }
};
std::string in_figures(const Pushed& pushed) {
    return pushed.has_left() ? std::string(pushed.tip > 0.0 ? "through" : "thrown out of") + " the block after " +
                                   figure(1e-3 * static_cast<double>(pushed.left_after), "s") + "; until then " +
                                   in_figures(pushed.judged)
                             : in_figures(pushed.judged) + ", tip " + figure(1e3 * pushed.tip, "mm") + " deep";
}

Pushed push_into(const Body& body, const ToolUnderTest& tool, const PortSettings& settings, const CouplingGains& gains,
                 double push, KerfLoop::Rendering rendering) {
    Port port(settings, above_face);
    port.go_along(true);
    KerfLoop loop(body, tool.setup, gains, above_face, rendering);
    loop.wait(port.reported(), run_up);
    Pushed pushed;
    std::size_t ticks = 0;
    Trace trace = press(
        port,
        [&](double depth, std::uint32_t missed) {
            if (pushed.has_left()) return 0.0;  // what flies on says nothing of bone
            const double force = loop.answer(depth, missed);
            pushed.tip = loop.tip();
            if (pushed.tip > thickness || pushed.tip < above_face - 1e-3) pushed.left_after = ticks;
            ++ticks;
            return force;
        },
        pushing, push, [&](double depth) { return loop.stored(depth); });
    trace.depth.resize(pushed.left_after);
    trace.force.resize(pushed.left_after);
    pushed.judged = judge(trace, settings.resolution, true);
    return pushed;
}

void check_damper(const DeviceRecord& device, const PortSettings& settings, double push, double scale,
                  const Report& report) {
    Finding finding = place_of(device, settings);
    finding.scene = "feed law as a damper, gain swept";
    finding.method = Method::as_printed;
    const double most = largest_damper(settings, push), limit = 2.0 * settings.moved_mass() / settings.period;
    finding.measured = "critical gain " + figure(most, "N s/m") + " = " + figure(most / limit) +
                       " x 2m/T, at the bone " + figure(most / scale, "N s/m");
    finding.criterion = "stable for " + figure(min_gain) + " ... " + figure(max_gain, "N s/m") + " of bone, scale 1/" +
                        figure(1.0 / scale);
    finding.outcome = passes(most >= max_gain * scale);
    report(finding);
}

}  // namespace

double largest_damper(PortSettings settings, double push) {
    settings.friction = settings.resolution = 0.0;
    constexpr Bracket widest{0.1, 1e6};  // [N·s/m]
    return widest.narrowed(1.002, [&](double gain) { return !alternates(settings, gain, push); }).middle();
}

void check_cutting(const Scope& scope, const ToolUnderTest& tool, const Report& report) {
    const Body body = make({.thickness = thickness, .spacing = 0.5e-3});
    at_every_port(scope, [&](const DeviceRecord& device, const PortSettings& settings) {
        const double push = push_of(device);
        const CouplingGains gains = gains_under_push(device, push, tool, body, settings.delay);
        check_damper(device, settings, push, gains.force_scale, report);
        for (const auto rendering : {KerfLoop::Rendering::direct, KerfLoop::Rendering::solved}) {
            const Pushed pushed = push_into(body, tool, settings, gains, push, rendering);
            Finding finding = place_of(device, settings);
            finding.scene = "the plugin's law, pushed into a block";
            finding.method = rendering == KerfLoop::Rendering::solved ? Method::kerf : Method::as_printed;
            finding.measured = "push " + figure(push, "N") + ": " + in_figures(pushed);
            const bool has_pauses = settings.clock == Clock::measured;
            finding.criterion = std::string("in the block; ") + (has_pauses ? calm_means : stable_means);
            finding.outcome =
                passes(!pushed.has_left() && (has_pauses ? pushed.judged.is_calm() : pushed.judged.is_stable()));
            if (rendering == KerfLoop::Rendering::solved && finding.outcome == Outcome::fail)
                finding.reason =
                    without_release + in_figures(push_into(body, tool, settings, unreleased(gains), push, rendering));
            report(finding);
        }
    });
}

}  // namespace kerf::stability
