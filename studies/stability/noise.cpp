// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "studies/scenes/bone_block.h"
#include "studies/stability/criterion.h"
#include "studies/stability/led_tool.h"
#include "studies/stability/scenes.h"
#include "studies/stability/unreleased.h"

namespace kerf::stability {

namespace {

constexpr double quick_feed = 2e-3, slow_feed = 0.5e-3;  // [m/s]
constexpr double engaged = 2.5e-3;  // [m] of the tip: the coupling is stretched by then as far as the feed asks
constexpr int longest = 20000, slow_ticks = 2000, stopping_ticks = 2000, still_ticks = 1000, looked_at = 500;

struct Heard {
    double mean = 0.0, rms = 0.0;  ///< [N]
    int turns = 0;
};

/// Of the last `looked_at` forces, about their means over 50 ms: what drifts is no noise.
Heard heard_in(const std::vector<double>& force) {
    constexpr std::size_t piece = 50;
    const std::span<const double> late = std::span(force).last(looked_at);
    Heard heard;
    double square = 0.0;
    for (std::size_t i = 0; i < late.size(); i += piece) {
        const auto part = late.subspan(i, piece);
        const double mean = std::accumulate(part.begin(), part.end(), 0.0) / piece;
        for (const double f : part) square += (f - mean) * (f - mean);
        heard.mean += mean * piece / looked_at;
    }
    heard.rms = std::sqrt(square / looked_at);
    heard.turns = max_turns({late.begin(), late.end()}, Simulation::dt);
    return heard;
}

struct Listened {
    Heard in_feed, at_rest;
};

/// A hand that moves, and what it feels.
struct Hand {
    std::function<double(double speed, double counts_off)>
        move;  ///< one tick at a speed [m/s], the encoder so many counts off: the force against it [N]
    std::function<double()> tip;  ///< [m] deep
};

/// Into the bone, then slowly on, then held still: first until the bone has given way as far as it will, then while the
/// encoder wavers by a count to either side.
Listened listen(const Hand& hand) {
    for (int i = 0; i < run_up; ++i) (void)hand.move(0.0, 0.0);
    for (int i = 0; i < longest && hand.tip() < engaged; ++i) (void)hand.move(quick_feed, 0.0);
    std::vector<double> fed, held;
    for (int i = 0; i < slow_ticks; ++i) fed.push_back(hand.move(slow_feed, 0.0));
    for (int i = 0; i < stopping_ticks; ++i) (void)hand.move(0.0, 0.0);
    std::uint32_t random = 6;
    for (int i = 0; i < still_ticks; ++i) {
        random = random * 1664525u + 1013904223u;
        held.push_back(hand.move(0.0, static_cast<double>((random >> 16) % 3u) - 1.0));
    }
    return {heard_in(fed), heard_in(held)};
}

constexpr double above = -0.3e-3;  // [m]

/// The hand is where it is told to be.
Listened listen_led(const Body& body, const ToolUnderTest& tool, const CouplingGains& gains, double count,
                    KerfLoop::Rendering rendering) {
    KerfLoop loop(body, tool.setup, gains, above, rendering);
    double hand = above;
    return listen({[&](double speed, double off) {
                       hand += speed * Simulation::dt;
                       return loop.answer((std::floor(hand / count + 0.5) + off) * count);
                   },
                   [&] { return loop.tip(); }});
}

/// A hand at a port moves so, with what it can push. While it wavers the encoder's own counts are part of that: it says
/// one count more or less than where the handle came to rest, until the handle is more than a count away from there.
Listened listen_at(const PortSettings& settings, const Body& body, const ToolUnderTest& tool,
                   const CouplingGains& gains, double push) {
    Port port(settings, above);
    port.go_along(true);
    KerfLoop loop(body, tool.setup, gains, above);
    double counts_off = 0.0, rest = 0.0;
    bool is_still = false;
    const LedTool hand = moved_at(port, loop, push, [&] {
        if (!is_still || std::abs(port.depth() - rest) > settings.resolution) rest = port.reported();
        return rest - port.reported() + counts_off * settings.resolution;
    });
    return listen({[&](double speed, double off) {
                       counts_off = off;
                       hand.move(speed);
                       is_still = speed == 0.0;
                       return port.held();
                   },
                   hand.tip});
}

std::string in_figures(const Heard& heard, double of) {
    return "RMS " + figure(100.0 * heard.rms / of, "%") + " of " + figure(of, "N") + ", " +
           std::to_string(heard.turns) + " turns";
}

}  // namespace

void check_noise(const Scope& scope, const ToolUnderTest& tool, const Report& report) {
    const Body body = make({.thickness = 16e-3});
    const auto tell = [&](Finding finding, const CouplingGains& gains, const auto& listened_with) {
        const Listened listened = listened_with(gains);
        finding.test = "S-06";
        finding.criterion = "RMS < 2 % of the feed's force, <=10 turns in 100 ms";
        const double of = listened.in_feed.mean;
        const auto add = [&](const char* scene, Heard Listened::*part) {
            const Heard& heard = listened.*part;
            const bool is_quiet = heard.rms < 0.02 * of && heard.turns <= 10;
            finding.scene = scene;
            finding.measured = in_figures(heard, of);
            finding.outcome = passes(is_quiet);
            finding.reason = "";
            if (finding.method == Method::kerf && !is_quiet) {
                const Listened without = listened_with(unreleased(gains));
                finding.reason = without_release + in_figures(without.*part, without.in_feed.mean);
            }
            report(finding);
        };
        add("feed of 0.5 mm/s", &Listened::in_feed);
        add("hold still, +-1 count", &Listened::at_rest);
    };
    for (const auto rendering : {KerfLoop::Rendering::direct, KerfLoop::Rendering::solved}) {
        const Method method = rendering == KerfLoop::Rendering::solved ? Method::kerf : Method::as_printed;
        for (const DeviceRecord& device : scope.devices) {
            const CouplingGains gains = gains_under_push(device, push_of(device), tool, body);
            const auto heard = [&](const CouplingGains& with) {
                return listen_led(body, tool, with, device.resolution, rendering);
            };
            tell({.method = method, .device = device.id, .hand = led}, gains, heard);
        }
    }
    at_every_port(scope, [&](const DeviceRecord& device, const PortSettings& settings) {
        const double push = push_of(device);
        const CouplingGains gains = gains_under_push(device, push, tool, body, settings.delay);
        const auto heard = [&](const CouplingGains& with) { return listen_at(settings, body, tool, with, push); };
        tell({.device = device.id, .hand = settings.hand.id, .delay = settings.delay}, gains, heard);
    });
}

}  // namespace kerf::stability
