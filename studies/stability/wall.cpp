// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/stability/wall.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "studies/scenes/bone_block.h"
#include "studies/stability/bracket.h"
#include "studies/stability/kerf_loop.h"
#include "studies/stability/press.h"
#include "studies/stability/touch_probe.h"
#include "studies/stability/unreleased.h"

namespace kerf::stability {

namespace {

constexpr double above_face = -0.1e-3;  // [m] where a press begins
constexpr int contact_ticks = 1500;

ForceOfDepth spring(double stiffness, double most = 1e300) {
    return [=](double depth) { return std::clamp(stiffness * depth, 0.0, most); };
}

/// A spring that also pulls, so that what grows goes on growing. Let go a millimetre beside its balance: does the mass
/// swing further out?
bool swings_out(const PortSettings& settings, double stiffness) {
    constexpr double start = 1e-3, seconds = 10.0, window = 3.0, settled = 0.5;
    Port port(settings, start);
    const auto ticks = [&](double time) { return static_cast<int>(std::lround(time / settings.period)); };
    double early = 0.0, late = 0.0;
    for (int i = 0; i < ticks(seconds); ++i) {
        port.step(stiffness * port.reported(), 0.0);
        const double out = std::abs(port.depth());
        if (out > 100.0 * start) return true;
        if (i >= ticks(settled) && i < ticks(settled + window)) early = std::max(early, out);
        if (i >= ticks(seconds - window)) late = std::max(late, out);
    }
    return late > early;
}

void check_the_boundary(const Scope& scope, const Report& report) {
    const std::vector<double> viscosities = scope.is_quick ? std::vector{0.1, 1.0} : std::vector{0.1, 0.3, 1.0, 2.0};
    const std::vector<double> periods =
        scope.is_quick ? std::vector{0.5e-3, 1e-3} : std::vector{0.25e-3, 0.5e-3, 1e-3, 2e-3};
    for (const double viscosity : viscosities)
        for (const double period : periods) {
            PortSettings settings{.viscosity = viscosity, .period = period};
            const double least = stiffest_wall(settings), theory = stiffest_wall_in_theory(settings);
            Finding finding{.test = "S-02", .scene = "largest stable K, sampled spring", .method = Method::as_printed};
            const std::string place = "75 g, b " + figure(viscosity) + ", T " + figure(1e3 * period, "ms") + ": ";
            finding.measured =
                place + figure(least, "N/m") + ", " + figure(100.0 * (least / theory - 1.0), "%") + " off";
            finding.criterion = "within 2 % of b/(T/2+t_d) = " + figure(theory, "N/m");
            finding.outcome = passes(std::abs(least / theory - 1.0) <= 0.02);
            report(finding);
            for (settings.delay = 1; settings.delay <= scope.max_delay; ++settings.delay) {
                const double ratio = stiffest_wall(settings) / least, expected = 1.0 / (1.0 + 2.0 * settings.delay);
                finding.test = "S-03";
                finding.delay = settings.delay;
                finding.measured = place + "ratio " + figure(ratio);
                finding.criterion = "ratio " + figure(expected) + " +- 5 %";
                finding.outcome = passes(std::abs(ratio / expected - 1.0) <= 0.05);
                report(finding);
            }
        }
}

void check_friction(const Scope& scope, const Report& report) {
    for (const DeviceRecord& device : scope.devices)
        for (int delay = 0; delay <= scope.max_delay; ++delay) {
            PortSettings settings = port_of(device, no_hand, delay);
            settings.resolution = 0.0;
            Finding finding{
                .test = "S-02", .scene = "largest stable K, with Coulomb friction", .method = Method::as_printed};
            finding.device = device.id;
            finding.delay = delay;
            const double with = stiffest_wall(settings), theory = stiffest_wall_in_theory(settings);
            finding.measured = figure(with, "N/m");
            finding.criterion = ">= b/(T/2+t_d) = " + figure(theory, "N/m");
            finding.outcome = passes(with >= theory);
            report(finding);
        }
}

Judged rest_on_wall(const Body& body, const PortSettings& settings, const CouplingGains& gains, double push) {
    Port port(settings, above_face);
    KerfLoop loop(body, touch_probe(1, rigid), gains, above_face);
    return judge(
        press(
            port, [&](double depth, std::uint32_t missed) { return loop.answer(depth, missed); }, contact_ticks, push),
        settings.resolution, false);
}

/// With the coupling's damping as it is: how stiff may its spring be? By halving, to a tenth.
double stiffest_coupling(const Body& body, const PortSettings& settings, CouplingGains gains, double push) {
    double stable = 0.0, unstable = gains.stiffness;
    while (unstable - stable > 0.1 * unstable && unstable > 1.0) {
        gains.stiffness = 0.5 * (stable + unstable);
        (rest_on_wall(body, settings, gains, push).is_stable() ? stable : unstable) = gains.stiffness;
    }
    return stable;
}

/// What would help where the default gains do not rest.
std::string remedy(const Body& body, const PortSettings& settings, const CouplingGains& gains, double push) {
    return "default K_c " + figure(gains.stiffness, "N/m") + ", rests up to about " +
           figure(stiffest_coupling(body, settings, gains, push), "N/m") + "; " + without_release +
           in_figures(rest_on_wall(body, settings, unreleased(gains), push));
}

}  // namespace

double stiffest_wall_in_theory(const PortSettings& settings) noexcept {
    return settings.viscosity / (settings.period * (0.5 + settings.delay));
}

double stiffest_wall(const PortSettings& settings) {
    constexpr Bracket widest{2.0, 1e5};  // [N/m]
    return widest.narrowed(1.0005, [&](double stiffness) { return !swings_out(settings, stiffness); }).middle();
}

/// A push of 2 N, or half of what the device has, from a tenth of a millimetre above the face.
void check_contact(const Scope& scope, const Report& report) {
    const Body body = make({.thickness = 8e-3});
    at_every_port(scope, [&](const DeviceRecord& device, const PortSettings& settings) {
        const double push = std::min(2.0, 0.5 * device.peak_force);
        const bool has_pauses = settings.clock == Clock::measured;
        Finding finding{.test = "S-02", .criterion = has_pauses ? calm_means : stable_means};
        finding.device = device.id;
        finding.hand = settings.hand.id;
        finding.delay = settings.delay;
        const CouplingGains gains = in_hands(gains_for(device, 1.0, settings.delay));
        const auto tell = [&](const char* scene, Method method, const Judged& judged) {
            finding.scene = scene;
            finding.method = method;
            finding.measured = in_figures(judged);
            finding.outcome = passes(has_pauses ? judged.is_calm() : judged.is_stable());
            const bool needs_remedy = method == Method::kerf && finding.outcome == Outcome::fail;
            finding.reason = needs_remedy ? remedy(body, settings, gains, push) : "";
            report(finding);
        };
        const auto as_printed = [&](double stiffness) {
            Port port(settings, above_face);
            return judge(press(port, spring(stiffness, device.peak_force), contact_ticks, push), settings.resolution,
                         false);
        };
        tell("wall of 20 kN/mm", Method::as_printed, as_printed(rigid));
        tell("wall as stiff as the coupling", Method::as_printed, as_printed(gains.stiffness));
        tell("wall of 20 kN/mm", Method::kerf, rest_on_wall(body, settings, gains, push));
    });
}

void check_walls(const Scope& scope, const Report& report) {
    check_the_boundary(scope, report);
    check_friction(scope, report);
    check_contact(scope, report);
}

}  // namespace kerf::stability
