// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/standing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/haptics/coupling.h"
#include "kerf/units.hpp"
#include "studies/chart/reference.h"
#include "studies/drawing/svg.h"
#include "studies/stability/bracket.h"
#include "studies/stability/kerf_loop.h"
#include "studies/stability/press.h"
#include "studies/stability/tool_under_test.h"

namespace kerf::chart {

namespace {

using namespace literals;
using drawing::figure;
using stability::Port;
using stability::PortSettings;

constexpr double felt = 0.05;  // [N]

/// What the tests are done with.
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
    [[nodiscard]] std::unique_ptr<Run> start() const { return start(fineness); }
    [[nodiscard]] std::unique_ptr<Run> start(const Fineness& at) const { return method.start(scene, at, gain); }
};

struct Verdict {
    bool passes;
    std::string told;
};

/// Mean force over the last millimetre of a way into the block [N].
double steady_force(const Bench& bench, const Fineness& fineness) {
    const auto run = bench.start(fineness);
    double sum = 0.0, count = 0.0;
    for (std::size_t t = 0; t < bench.scene.ticks(); ++t) {
        const Felt one = run->tick(bench.scene.pose_at(bench.scene.depth[t + 1]));
        if (bench.scene.depth[t] < bench.scene.depth.back() - 1.0_mm) continue;
        sum += length(linear(one.wrench));
        count += 1.0;
    }
    return sum / count;
}

Verdict with_twice_the_points(const Bench& bench) {
    Fineness twice = bench.fineness;
    twice.points *= 2;
    const double change = steady_force(bench, twice) / steady_force(bench, bench.fineness) - 1.0;
    return {std::abs(change) < 0.05, "twice the points: " + figure(100.0 * change) + " %"};
}

/// Into the block until the tip is 4.5 mm deep, out of the hole to 1 mm and into it again at 20 mm/s: whatever is felt
/// 0.05 mm and more before the deepest point. A hand that leads goes on until the tool has followed.
Verdict back_into_the_hole(const Bench& bench) {
    constexpr double bottom = 4.5_mm, top = 1.0_mm, before = 0.05_mm, speed = 20.0_mm_per_s;
    constexpr int longest = 20000;  // [ticks] of one way
    const auto run = bench.start();
    double hand = bench.scene.depth.front(), tip = hand, deepest = hand, most = 0.0;
    bool is_back = true;
    const auto lead = [&](double rate, const auto& is_there, bool is_in_the_hole) {
        int ticks = 0;
        for (; ticks < longest && !is_there(); ++ticks) {
            hand += rate * dt;
            const Felt one = run->tick(bench.scene.pose_at(hand));
            const double from = dot(one.from.position - bench.scene.entry, bench.scene.along);
            tip = from + one.rate * dt;
            if (is_in_the_hole && std::max(from, tip) < deepest - before)
                most = std::max(most, length(linear(one.wrench)));
            deepest = std::max(deepest, tip);
        }
        is_back = is_back && ticks < longest;
    };
    lead(
        bench.scene.feed, [&] { return tip >= bottom; }, false);
    lead(
        -speed, [&] { return tip <= top; }, false);
    lead(
        speed, [&] { return tip >= deepest - before; }, true);
    return {is_back && most < felt, is_back ? "back in the hole: " + figure(most) + " N" : "never back in the hole"};
}

/// The handle stands still in bone: first the drill turns, then it does not.
std::pair<Verdict, Verdict> standing_still(const Bench& bench) {
    const auto run = bench.start();
    double turning = 0.0, last = 0.0;
    bool is_finite_always = true;
    const auto stand = [&](int ticks) {
        for (int i = 0; i < ticks; ++i) {
            const Felt one = run->tick(bench.scene.pose_at(bench.scene.depth.back()));
            is_finite_always = is_finite_always && is_finite(linear(one.wrench));
            last = length(linear(one.wrench));
        }
    };
    for (std::size_t t = 0; t < bench.scene.ticks(); ++t)
        (void)run->tick(bench.scene.pose_at(bench.scene.depth[t + 1]));
    stand(50);
    turning = last;
    run->command_spindle(0.0);
    stand(50);
    return {{turning < felt, "standing, turning: " + figure(turning) + " N"},
            {is_finite_always, is_finite_always ? "" : "spindle off: not finite"}};
}

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
bool dies_down(const PortSettings& settings, const stability::Renderer& wall) {
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
    Standing standing{.method = method.id, .knob = knob_text(method, fineness)};
    std::vector<std::string> told;
    const auto add = [&](const char* id, const Verdict& verdict) {
        if (!verdict.passes) standing.fails.push_back(id);
        if (!verdict.told.empty()) told.push_back(std::string(id) + " " + verdict.told);
    };
    add("S-01", pushed_by_a_hand(bench));
    add("S-07", with_twice_the_points(bench));
    add("S-12", back_into_the_hole(bench));
    const auto [turning, off] = standing_still(bench);
    if (!method.is_solved) add("P9", turning);
    add("S-19", off);
    standing.told = drawing::joined(told, "; ");
    return standing;
}

}  // namespace kerf::chart
