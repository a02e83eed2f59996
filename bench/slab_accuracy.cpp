// SPDX-License-Identifier: Apache-2.0
// Thrust through the layered slab (C.9) against the exact lip integral of the same law, over random grid offsets.
// The feed is prescribed (`coupling: direct`), 5.4 mm drill, edge pitch 0.05 mm, 1000 rpm, 8 mm/s.
//
//     RMS(F − F_ref) / mean F_ref over the ticks in which an edge is in bone
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "tests/support/layered_slab.h"

int main() {
    using namespace kerf;
    using namespace literals;
    constexpr double rate = 8.0_mm_per_s, n = 1000.0_rpm;
    constexpr int offsets = 20, quadrature = 2000;
    const ToolSetup setup = test::twist_drill({{"diameter", 5.4_mm}, {"element_pitch", 0.05_mm}});
    const double feed_per_lip = rate / (2.0 * n);

    std::printf("tilt  spacing   rms thrust error, mean (worst) of %d offsets\n", offsets);
    for (const double tilt : {0.0_deg, 10.0_deg})
        for (const double h : {0.5_mm, 0.2_mm}) {
            std::mt19937 random(42);
            std::uniform_real_distribution<double> share(0.0, 1.0);
            double sum = 0.0, worst = 0.0;
            for (int k = 0; k < offsets; ++k) {
                const Body body = test::Slab::make(h, {share(random), share(random), share(random)});
                Simulation simulation(body, setup, test::outline(setup), test::gains(), test::at_depth(-1.0_mm, tilt));
                double error2 = 0.0, mean = 0.0, count = 0.0;
                const int ticks = static_cast<int>(22.5_mm / (rate * Simulation::dt));
                for (int t = 0; t < ticks; ++t) {
                    const double depth = -1.0_mm + t * rate * Simulation::dt;
                    const TickResult r = simulation.tick_direct({test::at_depth(depth + rate * Simulation::dt, tilt)});
                    // The motor follows at once, but it is told at the end of the first tick.
                    const double angle = 2.0 * pi * n * Simulation::dt * std::max(0, t - 1);
                    const double exact =
                        test::exact_thrust(setup, test::at_depth(depth, tilt), angle, feed_per_lip, quadrature);
                    if (exact <= 0.0) continue;
                    error2 += (r.thrust - exact) * (r.thrust - exact);
                    mean += exact;
                    count += 1.0;
                }
                const double relative = std::sqrt(error2 / count) / (mean / count);
                sum += relative;
                worst = std::max(worst, relative);
            }
            std::printf("%3.0f°  %4.2f mm   %5.2f %% (%.2f %%)\n", tilt / 1.0_deg, h * 1e3, 100.0 * sum / offsets,
                        100.0 * worst);
            std::fflush(stdout);
        }
    return 0;
}
