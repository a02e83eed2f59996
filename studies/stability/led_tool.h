// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>

#include "studies/papers/printed_loop.h"
#include "studies/stability/kerf_loop.h"
#include "studies/stability/port.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::stability {

/// A tool behind a hand that moves along one axis, whoever makes its force.
struct LedTool {
    std::function<void(double speed)> move;  ///< one tick of the hand at that speed [m/s]
    std::function<double()> tip, thrust;     ///< [m] deep, and [N] of bone against the shaft
    std::function<Vec3()> sideways;          ///< [N] of bone across the shaft, tool frame
    std::function<double()> torque,
        turning;  ///< [N·m] against the spin, and [1/s] as it was in the last tick; no number where nothing is said
};

/// What the loop makes of whatever its handle does. The loop outlives what is made of it, here and below.
[[nodiscard]] inline LedTool watched(KerfLoop& loop, std::function<void(double)> move) {
    return {std::move(move),
            [&loop] { return loop.tip(); },
            [&loop] { return loop.last().thrust; },
            [&loop] {
                return rotate(conjugate(loop.simulation().world_from_tool().rotation),
                              linear(loop.last().bone_on_tool));
            },
            [&loop] { return loop.last().torque; },
            [&loop] { return signal_of(loop.simulation().setup(), loop.simulation().signals(), "spindle_speed"); }};
}
/// The hand is where it is told to be, from `depth` on.
[[nodiscard]] inline LedTool led_by(KerfLoop& loop, double depth, double period) {
    return watched(loop, [&loop, depth, period](double speed) mutable { (void)loop.answer(depth += speed * period); });
}
/// The papers' spindle has no motor: it turns as it is told to.
[[nodiscard]] inline LedTool led_by(papers::PrintedLoop& loop, const ToolSetup& setup, double depth, double tilt,
                                    double period) {
    const double told = setup.drives.empty() ? std::nan("") : setup.drives.front();
    return {[&loop, depth, tilt, period](double speed) mutable { loop.go(at_depth(depth += speed * period, tilt)); },
            [&loop] {
                return dot(loop.at().position, rotate(loop.at().rotation, {0, 0, 1}));
            },
            [&loop] { return loop.thrust(); },
            [&loop] { return linear(loop.wrench()); },
            [&loop] { return loop.signal("t_tang"); },
            [told] { return told; }};
}
/// The hand at a port means to move so, and pulls the handle along with `most` [N] at most. What it means stays so near
/// that it pulls no harder; while it means to stand it goes on until the handle is where it was to stop. `beside`: what
/// the encoder is off [m]. The port outlives what is made of it.
[[nodiscard]] inline LedTool moved_at(Port& port, KerfLoop& loop, double most, std::function<double()> beside = {}) {
    constexpr double stiffness = 500.0, damping = 5.0;  // [N/m] [N·s/m] stable at the lightest handle [judgement]
    constexpr double to_stand =
        0.2;  // [s] in which it brings the handle back to there, stable at the heaviest [judgement]
    double meant = port.depth(), stop = port.depth();
    return watched(loop, [&port, &loop, most, meant, stop, beside = std::move(beside)](double speed) mutable {
        const PortSettings& settings = port.settings();
        const double farthest = most / stiffness,
                     friction = speed == 0.0 ? 0.0 : std::copysign(settings.friction, speed);
        if (speed != 0.0) stop = port.depth();
        const double back = (stop - port.depth()) * settings.period / to_stand;
        meant = std::clamp(meant + speed * settings.period + back, port.depth() - farthest, port.depth() + farthest);
        const double push = stiffness * (meant - port.depth()) + damping * (speed - port.rate()) + friction;
        const double pushed = std::clamp(push, -most, most);
        const std::uint32_t missed = port.wait_for_clock(pushed);
        port.step(loop.answer(port.reported() + (beside ? beside() : 0.0), missed), pushed);
    });
}

}  // namespace kerf::stability
