// SPDX-License-Identifier: Apache-2.0
// What a tick of burring costs: the round burr of 4 mm led by hand at 2 mm/s through a groove 1 mm deep in a shelled
// block, and a drill of 4 mm fed at 1 mm/s into the same block. Time on the processor, of this thread, as in
// bench_tick.
//
//     loop      all of a tick: the head and the neck sampled, the law, the solve, commit, the committed cut
//     no lag    the second field, which the worker stamps: not part of the loop
//     both      the two together
#include <algorithm>
#include <cstdio>
#include <functional>

#include "bench/tick_rows.h"
#include "core/field/grid/kernel/block_kernel.h"
#include "studies/times.h"
#include "tests/support/burr_rig.h"
#include "tests/support/drilled_block.h"

namespace {

using namespace kerf;
using namespace literals;

constexpr int ticks = 4000;
const Vec3 low{-8.0_mm, -8.0_mm, -14.0_mm}, high{16.0_mm, 8.0_mm, 0};

const NetTime cost_of([](const auto& work) { return processor_time_of(work); });

/// The ticks of a tool whose hand is at `hand(t)` at time t [s], from `settled` on.
void measure(const char* tool, const ToolSetup& setup, double h, double settled,
             const std::function<Pose(double)>& hand) {
    const Body body = test::shelled_block(low, high, 1.0_mm, h);
    Simulation simulation(body, setup, test::outline(setup), test::gains(), hand(0.0));
    double time = 0.0, force = 0.0;
    const auto next = [&] {
        time += Simulation::dt;
        return DeviceSample{hand(time)};
    };
    while (time < settled) (void)simulation.tick(next());
    bench::TickCosts costs;
    for (int i = 0; i < ticks; ++i)
        force += length(linear(costs.tick(simulation, next(), cost_of).bone_on_tool)) / ticks;
    std::printf("%s, spacing %.2f mm, %.1f N, kernel %s\n", tool, h / 1.0_mm, force, block_kernel().name);
    costs.print();
    std::fflush(stdout);
}

}  // namespace

int main() {
    std::printf("%s\n", bench::times_header);
    for (const double h : {0.5_mm, 0.25_mm, 0.2_mm}) {
        measure("round burr of 4 mm", test::round_burr(), h, 3.0, [](double t) {
            // From beside the block, at speed, then along the groove at 2 mm/s.
            const double x = t < 2.5 ? -12.0_mm + t * 4.0_mm_per_s : -2.0_mm + (t - 2.5) * 2.0_mm_per_s;
            return test::at_depth(1.0_mm, 0.0, {x, 0, 0});
        });
        measure("twist drill of 4 mm", test::twist_drill({{"diameter", 4.0_mm}}), h, 4.0,
                [](double t) { return test::at_depth(-1.0_mm + t * 1.0_mm_per_s); });
    }
    return 0;
}
