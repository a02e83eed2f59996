// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "conformance/stability/kerf_loop.h"
#include "conformance/stability/printed_loop.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::stability {

/// A tool behind a hand that is led along one axis, whoever makes its force.
struct LedTool {
    std::function<void(double depth)> go;     ///< one tick, in which the hand goes so deep [m]
    std::function<double()> tip, thrust;      ///< [m] deep, and [N] of bone against the shaft
    std::function<Vec3()> sideways;           ///< [N] of bone across the shaft, tool frame
    std::function<double()> torque, turning;  ///< [N·m] against the spin, and [1/s] as it was in the last tick; no number where nothing is said
};

/// The loop outlives what is made of it.
[[nodiscard]] inline LedTool led_by(KerfLoop& loop) {
    const auto wrench = [&loop] { return rotate(conjugate(loop.simulation().world_from_tool().rotation), linear(loop.last().bone_on_tool)); };
    return {[&loop](double depth) { (void)loop.answer(depth); },
            [&loop] { return loop.tip(); },
            [&loop] { return loop.last().thrust; },
            wrench,
            [&loop] { return loop.last().torque; },
            [&loop] { return signal_of(loop.simulation().setup(), loop.simulation().signals(), "spindle_speed"); }};
}
/// The papers' spindle has no motor: it turns as it is told to.
[[nodiscard]] inline LedTool led_by(PrintedLoop& loop, const ToolSetup& setup, double tilt = 0.0) {
    const double told = setup.drives.empty() ? std::nan("") : setup.drives.front();
    return {[&loop, tilt](double depth) { loop.go(at_depth(depth, tilt)); },
            [&loop] { return dot(loop.at().position, rotate(loop.at().rotation, {0, 0, 1})); },
            [&loop] { return loop.thrust(); },
            [&loop] { return linear(loop.wrench()); },
            [&loop] { return loop.signal("t_tang"); },
            [told] { return told; }};
}

}  // namespace kerf::stability
