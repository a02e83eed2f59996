// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>

#include "conformance/stability/bone_block.h"
#include "conformance/stability/criterion.h"
#include "conformance/stability/kerf_loop.h"
#include "conformance/stability/scenes.h"
#include "conformance/stability/unreleased.h"

namespace kerf::stability {

namespace {

constexpr double quick_feed = 2e-3, slow_feed = 0.5e-3;  // [m/s]
constexpr int quick_ticks = 1500, slow_ticks = 2000, still_ticks = 1000, looked_at = 500;

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
    heard.turns = most_turns({late.begin(), late.end()}, Simulation::dt);
    return heard;
}

struct Listened {
    Heard in_feed, at_rest;
};

/// Into the bone, then slowly on, then held still with a hand that wavers by a count to either side.
Listened listen(const Body& body, const ToolUnderTest& tool, const CouplingGains& gains, double count,
                KerfLoop::Way way) {
    constexpr double above = -0.3e-3;
    KerfLoop loop(body, tool.setup, gains, above, way);
    loop.wait(above, run_up);
    double hand = above;
    const auto answer = [&](double beside) { return loop.answer((std::floor(hand / count + 0.5) + beside) * count); };
    for (int i = 0; i < quick_ticks; ++i) {
        hand += quick_feed * Simulation::dt;
        (void)answer(0.0);
    }
    std::vector<double> fed, held;
    for (int i = 0; i < slow_ticks; ++i) {
        hand += slow_feed * Simulation::dt;
        fed.push_back(answer(0.0));
    }
    std::uint32_t random = 6;
    for (int i = 0; i < still_ticks; ++i) {
        random = random * 1664525u + 1013904223u;
        held.push_back(answer(static_cast<double>((random >> 16) % 3u) - 1.0));
    }
    return {heard_in(fed), heard_in(held)};
}

std::string in_figures(const Heard& heard, double of) {
    return "RMS " + figure(100.0 * heard.rms / of, "%") + " of " + figure(of, "N") + ", " +
           std::to_string(heard.turns) + " turns";
}

}  // namespace

void look_at_noise(const Scope& scope, const ToolUnderTest& tool, const Report& report) {
    const Body body = make({.thickness = 16e-3});
    for (const DeviceRecord& device : scope.devices)
        for (const auto way : {KerfLoop::Way::direct, KerfLoop::Way::solved}) {
            const CouplingGains gains = gains_under_push(device, push_of(device), tool, body);
            const auto [in_feed, at_rest] = listen(body, tool, gains, device.resolution, way);
            const auto [feed_without, rest_without] = listen(body, tool, unreleased(gains), device.resolution, way);
            Finding finding{.test = "S-06", .hand = led};
            finding.method = way == KerfLoop::Way::solved ? Method::kerf : Method::as_printed;
            finding.device = device.id;
            finding.criterion = "RMS < 2 % of the feed's force, <=10 turns in 100 ms";
            const auto tell = [&](const char* scene, const Heard& heard, const Heard& without) {
                const bool is_quiet = heard.rms < 0.02 * in_feed.mean && heard.turns <= 10;
                finding.scene = scene;
                finding.measured = in_figures(heard, in_feed.mean);
                finding.outcome = passes(is_quiet);
                finding.reason = way == KerfLoop::Way::solved && !is_quiet
                                     ? without_release + in_figures(without, feed_without.mean)
                                     : "";
                report(finding);
            };
            tell("feed of 0.5 mm/s", in_feed, feed_without);
            tell("hold still, +-1 count", at_rest, rest_without);
        }
}

}  // namespace kerf::stability
