// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include <algorithm>
#include <cmath>

#include "conformance/stability/bone_block.h"
#include "conformance/stability/kerf_loop.h"
#include "conformance/stability/scenes.h"

namespace kerf::stability {

void look_at_re_entry(const Scope& scope, const ToolUnderTest& tool, const Report& report) {
    constexpr double above = -0.3e-3, deep = 3e-3, shallow = 1e-3;  // [m]
    constexpr double feed = 2e-3, travel = 5e-3;                    // [m/s]
    constexpr int longest = 20000;                                  // [ticks]
    const Body body = make({.thickness = 16e-3});
    for (const DeviceRecord& device : scope.devices) {
        KerfLoop loop(body, tool.setup, gains_under_push(device, push_of(device), tool, body), above);
        loop.wait(above, run_up);
        double hand = above, deepest = 0.0, most = 0.0;
        const auto go = [&](double speed, const auto& until) {
            for (int i = 0; i < longest && !until(); ++i) {
                hand += speed * Simulation::dt;
                (void)loop.answer(hand);
                deepest = std::max(deepest, loop.tip());
            }
        };
        go(feed, [&] { return loop.tip() >= deep; });
        go(-travel, [&] { return loop.tip() <= shallow; });
        const bool is_out = loop.tip() <= shallow;
        // Up to a tick's travel before the front: from there on it is bone.
        go(travel, [&] {
            const bool is_there = loop.tip() >= deepest - 1.5 * travel * Simulation::dt;
            if (!is_there && loop.last().rate[2] > 0.0) most = std::max(most, std::abs(loop.last().thrust));
            return is_there;
        });
        Finding finding{.test = "S-12", .scene = "out of a hole and in again", .hand = led};
        finding.device = device.id;
        finding.measured = "at most " + figure(most, "N") + " of bone down to " + figure(1e3 * loop.tip(), "mm") +
                           " of " + figure(1e3 * deepest, "mm");
        finding.criterion = "< 0.05 N of bone before the front";
        finding.outcome = passes(is_out && most < 0.05 && loop.tip() > shallow + 1e-3);
        report(finding);
    }
}

}  // namespace kerf::stability
