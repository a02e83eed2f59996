// SPDX-License-Identifier: Apache-2.0
// What a tick of sawing costs: an oscillating blade of 40 teeth, all in bone, fed by hand at 1 mm/s through a shelled
// block. Time on the processor, of this thread, without what reading it costs. The same ticks run five times: other
// load of the machine falls on other ticks each time, so the least time of a tick is its own cost.
//
//     loop      all of a tick: the teeth and the sides sampled, the law, the solve, commit, the committed cut
//     no lag    the second field, which the worker stamps: not part of the loop
//     both      the two together
//     least     of the loop, of each tick the least of the five
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "bench/tick_rows.h"
#include "core/field/grid/kernel/block_kernel.h"
#include "studies/times.h"
#include "tests/support/drilled_block.h"
#include "tests/support/saw_rig.h"

namespace {

using namespace kerf;
using namespace literals;

constexpr double feed = 1.0_mm_per_s, approach = 3.0_mm_per_s;
constexpr int ticks = 3000, rounds = 5;

const NetTime cost_of([](const auto& work) { return processor_time_of(work); });

/// The ticks gone through once, each with what it took [us]; false: the saw does not come so deep.
bool saw(double h, bool is_told, bench::TickCosts& costs) {
    const Body body = test::shelled_block({-17.0_mm, -4.0_mm, -14.0_mm}, {17.0_mm, 4.0_mm, 0}, 2.0_mm, h);
    const ToolSetup setup = test::saw({{"tooth_count", 40.0}, {"tooth_pitch", 0.6_mm}, {"run_up", 200.0_ms}});
    Simulation simulation(body, setup, test::outline(setup), test::gains(), test::at_depth(-1.0_mm));
    double hand = -1.0_mm;
    const auto depth = [&] { return -simulation.world_from_tool().position.z; };
    const auto move = [&](double rate) {
        hand += rate * Simulation::dt;
        return DeviceSample{test::at_depth(hand)};
    };
    while (depth() < 5.0_mm) {
        (void)simulation.tick(move(approach));
        if (hand > 15.0_mm) {
            std::printf("the saw does not come so deep: it stands at %.2f mm\n", depth() / 1.0_mm);
            return false;
        }
    }
    for (int i = 0; i < ticks / 2; ++i) {  // until nothing of the approach waits any more
        (void)simulation.tick(move(feed));
    }
    const double from = depth();
    double teeth = 0.0;
    for (int i = 0; i < ticks; ++i) {
        (void)costs.tick(simulation, move(feed), cost_of);
        teeth += simulation.signals()[1] / ticks;
    }
    if (is_told)
        std::printf("spacing %.1f mm, from %.2f to %.2f mm deep, %.1f teeth in bone, kernel %s\n", h / 1.0_mm,
                    from / 1.0_mm, depth() / 1.0_mm, teeth, block_kernel().name);
    return true;
}

void measure(double h) {
    bench::TickCosts all;
    std::vector<double> least(ticks, std::numeric_limits<double>::max());
    for (int round = 0; round < rounds; ++round) {
        bench::TickCosts costs;
        if (!saw(h, round == 0, costs)) return;
        for (int i = 0; i < ticks; ++i) least[i] = std::min(least[i], costs.loop[i]);
        all.add(costs);
    }
    all.print();
    bench::print_row("least", least);
    std::fflush(stdout);
}

}  // namespace

int main() {
    std::printf("%s      (bars at 0.2 mm: loop mean 25, max 60)\n", bench::times_header);
    for (const double h : {0.5_mm, 0.2_mm}) measure(h);
    return 0;
}
