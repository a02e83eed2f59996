// SPDX-License-Identifier: Apache-2.0
#include "plugins/sawing/stroke.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "kerf/units.hpp"

namespace kerf::sawing {
namespace {

using namespace literals;

constexpr double inch = 25.4_mm;

// E03-1: 0.5 mm/s, a stroke of 3 mm, 18 teeth an inch, at the mean speed 2Su, which is |cos φ| = 2/π of the highest.
TEST(Stroke, AtItsMeanSpeedAChipIsFeedTimesPitchOverSpeed) {
    const struct {
        double rate, chip;
    } expected[] = {{8000.0_rpm, 0.882_um}, {10000.0_rpm, 0.706_um}, {15000.0_rpm, 0.470_um}};
    for (const auto& e : expected) {
        const Stroke stroke{3.0_mm, inch / 18.0, e.rate};
        EXPECT_NEAR(0.5_mm_per_s * chip_per_feed(stroke, 2.0 / pi), e.chip, 0.001_um) << e.rate;
    }
}

TEST(Stroke, WhereTheTeethTurnAChipIsTheAdvanceOfHalfACycleAndNoMore) {
    const Stroke stroke{5.0_mm, 1.4_mm, 200.0};
    EXPECT_EQ(chip_per_feed(stroke, 0.0), 1.0 / 400.0);
    EXPECT_EQ(chip_per_feed(stroke, 1e-9), 1.0 / 400.0) << "p/V would be a hundred metres for each metre a second";
    EXPECT_EQ(chip_per_feed(stroke, 0.5), chip_per_feed(stroke, -0.5)) << "to and fro alike";
}

// A saw whose stroke is shorter than 2/π of a pitch never reaches the next tooth's place: all at the cap.
TEST(Stroke, ShorterThanItsPitchIsAlwaysAtTheCap) {
    const Stroke stroke{0.5_mm, 1.4_mm, 200.0};
    EXPECT_NEAR(mean_chip_per_feed(stroke), 1.0 / 400.0, 1e-15);
}

// ∫ min(1/cos φ, M) dφ over a quarter = ln tan(φ_c/2 + π/4) + M (π/2 − φ_c), cos φ_c = 1/M.
TEST(Stroke, MeanChipIsTheIntegralOverTheOscillation) {
    for (const double pitch : {0.7_mm, 1.0_mm, 1.4_mm, 3.0_mm}) {
        const Stroke stroke{5.24_mm, pitch, 200.0};
        const double cap = pi * stroke.length / (2.0 * pitch), turn = std::acos(1.0 / cap);
        const double integral = std::log(std::tan(0.5 * turn + 0.25 * pi)) + cap * (0.5 * pi - turn);
        const double exact = pitch / (pi * stroke.rate * stroke.length) * integral / (0.5 * pi);
        EXPECT_NEAR(mean_chip_per_feed(stroke) / exact, 1.0, 0.002) << pitch;
    }
}

TEST(Stroke, TwoPartsStandForTheOscillationWithinAThirtiethAtAnyFeed) {
    const Stroke strokes[] = {{5.24_mm, 1.4_mm, 200.0}, {5.24_mm, 1.0_mm, 200.0}, {3.0_mm, inch / 18.0, 300.0}};
    constexpr int steps = 4000;
    double worst = 0.0;
    for (const Stroke& stroke : strokes)
        for (double edge_depth_per_feed = 1e-7; edge_depth_per_feed < 1.0; edge_depth_per_feed *= 1.3) {
            double exact = 0.0, two = 0.0;
            for (int i = 0; i < steps; ++i)
                exact += (1.0 - std::exp(-chip_per_feed(stroke, std::cos((i + 0.5) / steps * 0.5 * pi)) /
                                         edge_depth_per_feed)) /
                         steps;
            for (const StrokePart& part : parts_of(stroke))
                two += part.time_fraction * (1.0 - std::exp(-part.chip_per_feed / edge_depth_per_feed));
            worst = std::max(worst, std::abs(two / exact - 1.0));
        }
    RecordProperty("worst_percent", std::to_string(100.0 * worst));
    EXPECT_LT(worst, 0.033);
}

}  // namespace
}  // namespace kerf::sawing
