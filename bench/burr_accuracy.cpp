// SPDX-License-Identifier: Apache-2.0
// Accuracy against speed of a burr: a groove 1 mm deep with the round burr of 4 mm (validation F, scene 8), led at 0.5
// mm/s, by the number of points of its head and by the spacing.
//
//     force    error of the mean force in the groove against the law integrated over the front half of the cap [%]
//     change   largest change of the force within 20 ms of the groove [% of its mean]: what a grid makes of it
//     volume   error of the removed volume against the closed form [%]
//     tick     median and p99.9 of a tick that is led [us], on this machine
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "core/field/grid/kernel/block_kernel.h"
#include "studies/times.h"
#include "tests/support/burr_rig.h"

namespace {

using namespace kerf;
using namespace literals;

constexpr double radius = test::ball, depth = 1.0_mm, feed = 0.5_mm_per_s, speed = 30000.0 / 60.0, length_of = 6.0_mm;

const NetTime cost_of([](const auto& work) { return processor_time_of(work); });

/// The force of the groove [N], as tests/plugins/burring/groove_test.cpp has it.
Vec3 exact_force() {
    const auto law = defaults_of<burring::BurrCutting>();
    constexpr int pieces = 400;
    constexpr double blades = 6.0;
    Vec3 sum{};
    for (int i = 0; i < pieces; ++i)
        for (int j = 0; j < pieces; ++j) {
            const double theta = (i + 0.5) / pieces * pi / 3.0, phi = ((j + 0.5) / pieces - 0.5) * pi;
            const Vec3 normal{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), -std::cos(theta)};
            const Vec3 with_the_turn{std::sin(phi), -std::cos(phi), 0};
            const double t = feed * normal.x / (blades * speed);
            const double width = blades / (2.0 * pi) * radius * (pi / 3.0 / pieces) * (pi / pieces);
            sum = sum - width * (force_per_width(t, law.thrust()) * normal +
                                 force_per_width(t, law.cutting()) * with_the_turn);
        }
    return sum;
}
double exact_volume() {
    const double area = radius * radius * std::acos((radius - depth) / radius) -
                        (radius - depth) * std::sqrt(2.0 * radius * depth - depth * depth);
    return area * length_of + 0.5 * pi * depth * depth * (3.0 * radius - depth) / 3.0;
}

void measure(double points, double h) {
    test::LedBurr burr(test::block({0, -6.0_mm, -5.0_mm}, {10.0_mm, 6.0_mm, 0}, h, {0.31, 0.17, 0.73}),
                       test::round_burr({{"edge_points", points}, {"spindle_speed", speed}}),
                       {-3.0_mm, 0, radius - depth});
    burr.to({4.0_mm, 0, radius - depth}, 5.0_mm_per_s);
    for (int i = 0; i < 400; ++i) (void)burr.go({feed, 0, 0});
    std::vector<double> size, ticks;
    Vec3 sum{};
    constexpr int count = 3000;
    for (int i = 0; i < count; ++i) {
        TickResult r;
        ticks.push_back(cost_of([&] { r = burr.go({feed, 0, 0}); }));
        sum = sum + linear(r.bone_on_tool);
        size.push_back(length(linear(r.bone_on_tool)));
    }
    const Vec3 mean = (1.0 / count) * sum, exact = exact_force();
    double change = 0.0;
    for (std::size_t i = 20; i < size.size(); ++i) change = std::max(change, std::abs(size[i] - size[i - 20]));
    burr.to({length_of, 0, radius - depth}, 5.0_mm_per_s);
    const double volume = burr.removed();
    const Times t = times_of(ticks);
    std::printf("%6.0f %8.3f %9.2f %9.2f %9.3f %9.2f %9.2f\n", points, h / 1.0_mm,
                100.0 * length(mean - exact) / length(exact), 100.0 * change / length(mean),
                100.0 * (volume / exact_volume() - 1.0), t.median, t.p999);
    std::fflush(stdout);
}

}  // namespace

int main() {
    std::printf("groove 1 mm deep, 0.5 mm/s, 30000 rpm, exact force %.3f N, kernel %s\n", length(exact_force()),
                block_kernel().name);
    std::printf("points  spacing  force[%%] change[%%] volume[%%] tick[us]     p99.9\n");
    for (const double h : {0.5_mm, 0.25_mm, 0.125_mm})
        for (const double points : {24.0, 48.0, 84.0, 168.0, 336.0}) measure(points, h);
    return 0;
}
