// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/drill/standing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "core/haptics/loop/coupling.h"
#include "kerf/units.hpp"
#include "studies/chart/drill/measure.h"
#include "studies/chart/drill/reference.h"
#include "studies/chart/trial.h"
#include "studies/stability/bracket.h"
#include "studies/stability/kerf_loop.h"
#include "studies/stability/press.h"
#include "studies/stability/tool_under_test.h"

namespace kerf::chart {

namespace {

using namespace literals;
using stability::Port;
using stability::PortSettings;

/// What the tests of a drill are done with.
struct Bench {
    const Method& method;
    const CuttingLaw& law;
    Fineness fineness;
    Scene scene;  ///< a block
    double gain;

    Bench(const Method& m, const CuttingLaw& l, const Fineness& f)
        : method(m),
          law(l),
          fineness(f),
          scene(block_scene(slab_scene(0.0), 5.0_mm)),
          gain(calibration(m, scene, l, f)) {
        fineness.offset = {0.31, 0.17, 0.73};
    }
    [[nodiscard]] double thrust() const {
        return -edge_wrench(scene.drill, law, wholly_engaged(scene.drill), 0.0, scene.feed / (2.0 * scene.spindle))[2];
    }
    [[nodiscard]] Trial trial() const {
        return {.start =
                    [this](double more_points) {
                        Fineness at = fineness;
                        at.points = static_cast<int>(std::lround(more_points * at.points));
                        return method.start(scene, at, gain);
                    },
                .pose_at = [this](double depth) { return scene.pose_at(depth); },
                .entry = scene.entry,
                .along = scene.along,
                .depth = scene.depth,
                .feed = scene.feed,
                .bottom = 4.5_mm,
                .top = 1.0_mm};
    }
};

/// A hand pushes for two seconds, at a scale at which its push is what the scene's feed needs.
Verdict pushed_by_a_hand(const Bench& bench) {
    const DeviceRecord& device = *find_device("premium-1.5-6dof");
    const double push = stability::push_of(device), scale = std::min(1.0, push / bench.thrust());
    const PortSettings settings = port_of(device, stability::test_hands[2], 0);
    constexpr double above = -0.5_mm;
    constexpr int ticks = 2000;
    Port port(settings, above);
    port.go_along(true);
    Scene scene = bench.scene;
    scene.depth.front() = above;
    scene.bone.low.z = -60.0_mm;  // deep enough for whatever happens
    const auto run = bench.method.start(scene, bench.fineness, bench.gain);
    for (int i = 0; i < 2; ++i) (void)run->tick(scene.pose_at(above));
    bool is_lost = false;
    const auto trace = stability::press(
        port,
        [&](double depth) {
            if (is_lost || depth > 50.0_mm || depth < -200.0_mm) {
                is_lost = true;
                return 0.0;
            }
            const Felt one = run->tick(scene.pose_at(depth));
            const double force = bench.method.is_solved ? one.commanded : -scale * one.wrench[2];
            if (!std::isfinite(force)) is_lost = true;
            return is_lost ? 0.0 : std::clamp(force, -device.peak_force, device.peak_force);
        },
        ticks, push);
    const auto judged = stability::judge(trace, settings.resolution, true);
    return {judged.is_stable() && !is_lost,
            std::string("pushed: ") + (is_lost ? "thrown out of the block" : stability::in_figures(judged))};
}

// ---- K_max --------------------------------------------------------------------------------------------------------

constexpr double above_wall = -0.1_mm;

/// Whether the bare device, pushed onto a wall with 2 N, swings less and less: the same question for all methods.
bool dies_down(const PortSettings& settings, const stability::ForceOfDepth& wall) {
    constexpr double push = 2.0, still = 1e-6;  // [N], [m]
    constexpr std::size_t ticks = 10000, settled = 500, window = 3000;
    Port port(settings, above_wall);
    const std::vector<double> depth = stability::press(port, wall, ticks, push).depth;
    const auto swing = [&](std::size_t from) {
        const auto [least, most] = std::minmax_element(depth.begin() + static_cast<std::ptrdiff_t>(from),
                                                       depth.begin() + static_cast<std::ptrdiff_t>(from + window));
        return *most - *least;
    };
    return swing(ticks - window) < std::max(still, swing(settled));
}

/// The stiffest [N/m] of those for which `holds` says so, within 2 %.
template <class Holds>
double stiffest_of(const Holds& holds) {
    constexpr stability::Bracket widest{10.0, 1e5};
    return holds(widest.holds) ? widest.narrowed(1.02, holds).holds : 0.0;
}

}  // namespace

double stiffest(const Method& method, const CuttingLaw& law) {
    const DeviceRecord& device = *find_device("premium-1.5-6dof");
    PortSettings settings = port_of(device, stability::no_hand, 0);
    settings.friction = settings.resolution = 0.0;
    if (!method.is_solved)
        return stiffest_of([&](double stiffness) {
            return dies_down(settings, [=](double depth) { return std::max(0.0, stiffness * depth); });
        });
    const Bench bench(method, law, {.spacing = 0.5_mm, .points = 31});
    const Body body = body_of(bench.scene.bone, bench.fineness.spacing, bench.fineness.offset);
    ToolSetup setup = method.setup(bench.scene, bench.fineness);
    setup.drives[0] = 0.0;
    return stiffest_of([&](double stiffness) {
        CouplingGains gains = gains_for(device, 1.0);
        gains.stiffness = stiffness;
        stability::KerfLoop loop(body, setup, gains, above_wall);
        return dies_down(settings, [&](double depth) { return loop.answer(depth); });
    });
}

Standing standing_of(const Method& method, const CuttingLaw& law, const Fineness& fineness) {
    const Bench bench(method, law, fineness);
    Standing standing{.method = method.id, .knob = knob_text(method.knob, fineness)};
    standing.add("S-01", pushed_by_a_hand(bench));
    standing.add_trials(bench.trial(), method.is_solved);
    return standing;
}

}  // namespace kerf::chart
