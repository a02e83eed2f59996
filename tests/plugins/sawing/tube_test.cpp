// SPDX-License-Identifier: Apache-2.0
// A shaft of bone, sawn across: 26 mm with a canal of 10.6 mm (E.1).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "plugins/sawing/saw_force.h"
#include "tests/support/rig.h"
#include "tests/support/saw_rig.h"

namespace kerf {
namespace {

using namespace literals;

constexpr double outer = 13.0_mm, inner = 5.3_mm, rate = 8.0_mm_per_s;

/// How much of the front's arc lies in the tube, the tip at `depth` below its highest line [m].
double arc_in_tube(const sawing::SawBlade& blade, double depth) {
    constexpr int steps = 20000;
    const double half = blade.half_front();
    double in = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double angle = half * (2.0 * (i + 0.5) / steps - 1.0);
        const double x = blade.radius * std::sin(angle), z = outer - depth + blade.radius * (1.0 - std::cos(angle));
        const double r = std::hypot(x, z);
        in += r < outer && r > inner ? 1.0 : 0.0;
    }
    return in / steps * 2.0 * half * blade.radius;
}

Pose above(double depth) { return test::at_depth(depth, 0.0, {0, 0, outer}); }

// C.7, 03-09: N(y) = ℓ/p, and none once through.
TEST(SawnTube, HasAsManyTeethInBoneAsTheChordHoldsPitches) {
    for (const double h : {0.5_mm, 0.25_mm}) {
        const ToolSetup setup = test::saw();
        const sawing::SawBlade blade = value_of<sawing::OscillatingBlade>(setup.tool_parameters).blade();
        test::Rig simulation(test::tube(outer, inner, 3.0_mm, h), setup, above(-1.0_mm));
        double worst = 0.0, most = 0.0;
        for (double depth = -1.0_mm; depth < 29.0_mm; depth += rate * Simulation::dt) {
            (void)simulation.tick_direct({above(depth)});
            const double teeth = signals_of<sawing::SawCutting>(simulation.signals()).engaged_teeth,
                         exact = arc_in_tube(blade, depth) / blade.pitch;
            worst = std::max(worst, std::abs(teeth - exact));
            most = std::max(most, exact);
        }
        RecordProperty("worst_at_" + std::to_string(static_cast<int>(h * 1e6)) + "_um", std::to_string(worst));
        EXPECT_GT(most, 15.0);
        EXPECT_LE(worst, 1.0) << "teeth, at " << h;
        EXPECT_EQ(signals_of<sawing::SawCutting>(simulation.signals()).engaged_teeth, 0.0) << "through";
    }
}

// The load follows the teeth: what each of them resists at this feed, times how many there are.
TEST(SawnTube, LoadIsThatOfTheTeethInBone) {
    const ToolSetup setup = test::saw();
    const sawing::SawBlade blade = value_of<sawing::OscillatingBlade>(setup.tool_parameters).blade();
    test::Rig simulation(test::tube(outer, inner, 3.0_mm, 0.5_mm), setup, above(-1.0_mm));
    const sawing::Stroke stroke{blade.stroke(), blade.pitch, setup.drives[0]};
    double per_tooth = 0.0;
    for (const auto& part : sawing::parts_of(stroke))
        per_tooth +=
            part.time_fraction * blade.kerf() *
            force_per_width(part.chip_per_feed * rate, value_of<sawing::SawCutting>(setup.force_parameters).thrust());
    for (double depth = -1.0_mm; depth < 29.0_mm; depth += rate * Simulation::dt) {
        const double thrust = simulation.tick_direct({above(depth)}).thrust;
        ASSERT_NEAR(thrust / per_tooth, arc_in_tube(blade, depth) / blade.pitch,
                    1.3 /* a tooth, and the front's slant of 4 % */)
            << depth;
    }
}

// C.1: k π (R_o² − R_i²).
TEST(SawnTube, LosesItsRingsAreaTimesTheKerf) {
    for (const double h : {0.5_mm, 0.4_mm, 0.25_mm}) {
        test::Rig simulation(test::tube(outer, inner, 3.0_mm, h), test::saw(), above(-1.0_mm));
        for (double depth = -1.0_mm; depth < 29.5_mm; depth += 20.0_mm_per_s * Simulation::dt) {
            (void)simulation.tick_direct({above(depth)});
        }
        simulation.finish();
        const double removed = simulation.present().removed();
        const double exact = 1.0_mm * pi * (outer * outer - inner * inner);
        RecordProperty("volume_at_" + std::to_string(static_cast<int>(h * 1e6)) + "_um",
                       std::to_string(removed / exact));
        EXPECT_NEAR(removed / exact, 1.0, 1e-4) << "at " << h << ", a kerf of 1 mm";
    }
}

}  // namespace
}  // namespace kerf
