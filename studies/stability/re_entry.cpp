// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include <algorithm>
#include <cmath>

#include "studies/scenes/bone_block.h"
#include "studies/stability/led_tool.h"
#include "studies/stability/scenes.h"
#include "studies/worst.h"

namespace kerf::stability {

namespace {

constexpr double above = -0.3e-3, deep = 3e-3, shallow = 1e-3;  // [m]

struct BackAgain {
    bool is_out = false;
    double front = 0.0;               ///< [N] of bone while it drilled
    double most = 0.0;                ///< [N] of bone on the way back in, before the front
    double deepest = 0.0, end = 0.0;  ///< [m] of the tip
    [[nodiscard]] bool is_empty() const noexcept {
        return is_out && front >= 0.05 && most < 0.05 && end > shallow + 1e-3;
    }
};

BackAgain out_and_in(const LedTool& tool) {
    constexpr double feed = 2e-3, travel = 5e-3;  // [m/s]
    constexpr int longest = 20000;                // [ticks]
    for (int i = 0; i < run_up; ++i) tool.move(0.0);
    BackAgain again;
    double last = tool.tip();
    const auto go = [&](double speed, const auto& until) {
        for (int i = 0; i < longest && !until(); ++i) {
            last = tool.tip();
            tool.move(speed);
            again.deepest = std::max(again.deepest, tool.tip());
        }
    };
    go(feed, [&] { return tool.tip() >= deep; });
    again.front = std::abs(tool.thrust());
    go(-travel, [&] { return tool.tip() <= shallow; });
    again.is_out = tool.tip() <= shallow;
    // Up to a tick's travel before the front: from there on it is bone.
    go(travel, [&] {
        const double way = std::max(travel * Simulation::dt, tool.tip() - last);
        const bool is_there = tool.tip() >= again.deepest - 1.5 * way;
        if (!is_there && tool.tip() > last) again.most = worst(again.most, std::abs(tool.thrust()));
        return is_there;
    });
    again.end = tool.tip();
    return again;
}

Finding finding_of(const BackAgain& again) {
    Finding finding{.test = "S-12", .scene = "out of a hole and in again", .hand = led};
    finding.measured = "at most " + figure(again.most, "N") + " of bone down to " + figure(1e3 * again.end, "mm") +
                       " of " + figure(1e3 * again.deepest, "mm") + ", " + figure(again.front, "N") + " as it drilled";
    finding.criterion = "< 0.05 N of bone before the front";
    finding.outcome = passes(again.is_empty());
    return finding;
}

}  // namespace

void check_re_entry(const Scope& scope, const ToolUnderTest& tool, const ToolUnderTest* printed, const Report& report) {
    const BoneBlock block{.thickness = 16e-3};
    const Body body = make(block);
    Finding as_printed{.test = "S-12", .scene = "out of a hole and in again", .hand = led, .reason = papers::no_papers};
    if (printed != nullptr) {
        papers::PrintedLoop loop(block, body.grid(), printed->setup, at_depth(above), Simulation::dt);
        as_printed = finding_of(out_and_in(led_by(loop, printed->setup, above, 0.0, Simulation::dt)));
        as_printed.reason = "its bone stays until the drilling ends";
    }
    as_printed.method = Method::as_printed;
    report(as_printed);
    for (const DeviceRecord& device : scope.devices) {
        KerfLoop loop(body, tool.setup, gains_under_push(device, push_of(device), tool, body), above);
        Finding finding = finding_of(out_and_in(led_by(loop, above, Simulation::dt)));
        finding.device = device.id;
        report(finding);
    }
    at_every_port(scope, [&](const DeviceRecord& device, const PortSettings& settings) {
        const double push = push_of(device);
        Port port(settings, above);
        port.go_along(true);
        KerfLoop loop(body, tool.setup, gains_under_push(device, push, tool, body, settings.delay), above);
        Finding finding = finding_of(out_and_in(moved_at(port, loop, push)));
        finding.device = device.id;
        finding.hand = settings.hand.id;
        finding.delay = settings.delay;
        report(finding);
    });
}

}  // namespace kerf::stability
