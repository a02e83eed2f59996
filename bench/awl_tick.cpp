// SPDX-License-Identifier: Apache-2.0
// What a tick costs while a tip that does not turn is pushed: an awl of 4 mm led through bone at 2 mm/s, beside a drill
// of 3.2 mm that cuts cortex at the same rate. Time on the processor, of this thread, in one run; each row is gone
// through three times.
//
//     drill     it turns, 3 … 6 mm deep in cortex
//     stands    on cortex with the spring of its contact: bone is asked each tick whether it gives way
//     crushes   spongy bone, its far side nowhere near
//     wall      a plate of 1 mm in the 2 mm about where it breaks
//     ratio     mean of the row / mean of the drill
#include <cstdio>
#include <vector>

#include "bench/tick_rows.h"
#include "studies/times.h"
#include "tests/support/drill_rig.h"

namespace {

using namespace kerf;
using namespace literals;

constexpr double feed = 2.0_mm_per_s;
constexpr int rounds = 3;

/// One row: what is led through what, and where it is measured.
struct Row {
    const char* name;
    bool turns;
    double thickness, density;  ///< [m], [kg/m³]
    double from, to;            ///< [m] depth of the tip
};

ToolSetup tool_of(const Row& row) {
    if (row.turns) return test::twist_drill();
    return test::drill("profile_drill", {{"spindle_speed", 0.0},
                                         {"diameter", 0.5_mm},
                                         {"point_angle", 60.0_deg},
                                         {"depth_1", 6.96_mm},
                                         {"diameter_1", 4.0_mm}});
}

void go_through(const Row& row, double h, std::vector<double>& microseconds) {
    Body body = test::block({-8.0_mm, -8.0_mm, -row.thickness}, {8.0_mm, 8.0_mm, 0}, h, {0.31, 0.17, 0.73});
    body.materials = {{"bone", row.density, {}}};
    const ToolSetup setup = tool_of(row);
    Simulation simulation(body, setup, test::outline(setup), test::gains(), test::at_depth(-0.05_mm));
    for (double depth = -0.05_mm; depth < row.to; depth += feed * Simulation::dt) {
        const DeviceSample sample{test::at_depth(depth)};
        const double took = processor_time_of([&] { (void)simulation.loop().tick_direct(sample); });
        simulation.follow();
        if (depth >= row.from) microseconds.push_back(took);
    }
}

void measure(double h) {
    std::printf("spacing %.2f mm\n", h / 1.0_mm);
    double of_drill = 0.0;
    for (const Row& row :
         {Row{"drill", true, 12.0_mm, 1850.0, 3.0_mm, 6.0_mm}, Row{"stands", false, 12.0_mm, 1850.0, 0.0, 0.08_mm},
          Row{"crushes", false, 20.0_mm, 300.0, 3.0_mm, 8.0_mm}, Row{"wall", false, 1.0_mm, 1850.0, 0.5_mm, 2.5_mm}}) {
        std::vector<double> took;
        for (int round = 0; round < rounds; ++round) go_through(row, h, took);
        const double mean = bench::print_times(row.name, took).mean;
        if (row.turns) of_drill = mean;
        std::printf("   %6.2f   (%zu ticks)\n", mean / of_drill, took.size());
        std::fflush(stdout);
    }
}

}  // namespace

int main() {
    std::printf("%s    ratio\n", bench::times_header);
    for (const double h : {0.5_mm, 0.2_mm}) measure(h);
    return 0;
}
