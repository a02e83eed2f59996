// SPDX-License-Identifier: Apache-2.0
// What a tick of sawing costs: an oscillating blade of 40 teeth, all in bone, fed by hand at 1 mm/s through a shelled block.
// Time on the processor, of this thread.
//
//     loop      all of a tick: the teeth and the sides asked about, the law, the solve, commit, the committed cut stamped
//     no lag    the second field, which the worker stamps: not part of the loop
//     both      the two together
#include <cmath>
#include <cstdio>

#include "conformance/times.h"
#include "core/field/block_kernel.h"
#include "tests/support/drilled_block.h"
#include "tests/support/saw_rig.h"

namespace {

using namespace kerf;
using namespace literals;

constexpr double feed = 1.0_mm_per_s, approach = 3.0_mm_per_s;
constexpr int ticks = 3000;

void print(const char* what, const std::vector<double>& microseconds) {
    const Times t = times_of(microseconds);
    std::printf("  %-8s %9.2f %9.2f %9.2f %9.2f\n", what, t.mean, t.median, t.p999, t.longest);
}

void measure(double h) {
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
        simulation.after_tick();
        if (hand > 15.0_mm) {
            std::printf("the saw does not come so deep: it stands at %.2f mm\n", depth() / 1.0_mm);
            return;
        }
    }
    for (int i = 0; i < ticks / 2; ++i) {  // until nothing of the approach waits any more
        (void)simulation.tick(move(feed));
        simulation.after_tick();
    }
    const double from = depth();
    std::vector<double> loop, no_lag, both;
    double teeth = 0.0;
    for (int i = 0; i < ticks; ++i) {
        const DeviceSample sample = move(feed);
        const double in_loop = processor_time_of([&] { (void)simulation.tick(sample); });
        const double by_worker = processor_time_of([&] { simulation.after_tick(); });
        loop.push_back(in_loop);
        no_lag.push_back(by_worker);
        both.push_back(in_loop + by_worker);
        teeth += simulation.signals()[1] / ticks;
    }
    std::printf("spacing %.1f mm, from %.2f to %.2f mm deep, %.1f teeth in bone, kernel %s\n", h / 1.0_mm, from / 1.0_mm, depth() / 1.0_mm, teeth,
                block_kernel().name);
    print("loop", loop);
    print("no lag", no_lag);
    print("both", both);
    std::fflush(stdout);
}

}  // namespace

int main() {
    std::printf("[us]            mean    median     p99.9       max      (bars at 0.2 mm: loop mean 25, max 60)\n");
    for (const double h : {0.5_mm, 0.2_mm}) measure(h);
    return 0;
}
