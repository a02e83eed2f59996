// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include <algorithm>
#include <cmath>

#include "conformance/stability/bone_block.h"
#include "conformance/stability/kerf_loop.h"
#include "conformance/stability/scenes.h"
#include "kerf/units.hpp"

namespace kerf::stability {

namespace {

constexpr double shell = 3e-3;                 // [m]
constexpr double hard = 1850.0, soft = 585.0;  // [kg/m³] the law takes the square: 10 : 1
constexpr double slowest_feed = 0.5e-3, fastest_feed = 10e-3;  // [m/s] that the test asks for

struct Crossing {
    double before = 0.0, after = 0.0, step = 0.0;  ///< [N] thrust on either side, its largest change in a tick
    double fastest = 0.0;                          ///< [m/s] of the tip
};

Crossing cross(const Body& body, const ToolUnderTest& tool, const CouplingGains& gains, double feed, double tilt,
               KerfLoop::Way way, double period = Simulation::dt) {
    constexpr double above = -0.5e-3, approach = 2e-3, margin = 0.2e-3;
    const int ticks_per_nominal = static_cast<int>(std::lround(Simulation::dt / period)), longest = 20000 * ticks_per_nominal;
    KerfLoop loop(body, tool.setup, gains, above, way, tilt, period);
    loop.wait(above, run_up * ticks_per_nominal);
    double hand = above;
    const double spread = tool.radius * std::tan(tilt);
    const double from = shell / std::cos(tilt) - spread - margin;
    const double until = shell / std::cos(tilt) + tool.full_depth + spread + margin;
    const auto go = [&](double speed) {
        hand += speed * period;
        (void)loop.answer(hand);
    };
    for (int i = 0; i < longest && loop.tip() < from - 0.3e-3; ++i) go(approach);
    for (int i = 0; i < longest && loop.tip() < from; ++i) go(feed);
    Crossing crossing{.before = loop.last().thrust};
    double last = crossing.before;
    for (int i = 0; i < longest && loop.tip() < until; ++i) {
        const double was = loop.tip();
        go(feed);
        crossing.fastest = std::max(crossing.fastest, (loop.tip() - was) / period);
        crossing.step = std::max(crossing.step, std::abs(loop.last().thrust - last));
        last = loop.last().thrust;
    }
    crossing.after = last;
    return crossing;
}

}  // namespace

void look_at_border(const Scope& scope, const ToolUnderTest& tool, const Report& report) {
    const Body body = make({.thickness = 10e-3, .density = hard, .shell = shell, .inner = soft});
    for (const DeviceRecord& device : scope.devices)
        for (const double tilt : {0.0, 10.0})
            for (const double feed : {slowest_feed, 2e-3, fastest_feed})
                for (const auto way : {KerfLoop::Way::direct, KerfLoop::Way::solved}) {
                    const CouplingGains gains = gains_under_push(device, push_of(device), tool, body);
                    const Crossing crossing = cross(body, tool, gains, feed, tilt * pi / 180.0, way);
                    const double step = crossing.step / crossing.before;
                    const bool is_led_by_spring = way == KerfLoop::Way::solved;
                    Finding finding{.test = "S-16", .hand = led};
                    finding.scene = "border 10 : 1 at " + figure(1e3 * feed, "mm/s") + (is_led_by_spring ? ", by a spring" : ", prescribed");
                    finding.device = device.id;
                    finding.measured = figure(tilt, "deg") + ": step " + figure(100.0 * step, "%") + " a tick, " +
                                       figure(crossing.before, "N") + " -> " + figure(crossing.after, "N");
                    finding.criterion = "<= 3.2 % of the force before, a tick";
                    finding.outcome = passes(step <= 0.032);
                    if (finding.outcome == Outcome::fail) {  // is it a step, or does it fall as steeply in shorter ticks?
                        const Crossing finer = cross(body, tool, gains, feed, tilt * pi / 180.0, way, 0.25 * Simulation::dt);
                        finding.reason = "at a quarter of the tick: step " + figure(100.0 * finer.step / finer.before, "%");
                    }
                    if (is_led_by_spring && crossing.fastest > fastest_feed) {
                        finding.outcome = Outcome::not_applicable;
                        finding.reason = "the spring lets the drill cross at up to " + figure(1e3 * crossing.fastest, "mm/s") +
                                         ", the test has " + figure(1e3 * slowest_feed) + " to " + figure(1e3 * fastest_feed) + (finding.reason.empty() ? "" : "; " + finding.reason);
                    }
                    report(finding);
                }
}

}  // namespace kerf::stability
