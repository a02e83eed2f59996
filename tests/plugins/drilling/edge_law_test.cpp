// SPDX-License-Identifier: Apache-2.0
#include "plugins/drilling/edge_law.h"

#include <gtest/gtest.h>

#include "kerf/units.hpp"

namespace kerf::drilling {
namespace {

using namespace literals;

// Round numbers, so that a reader can check every answer by hand.
constexpr EdgeCoefficients textbook{.edge = 10.0_N_per_mm, .edge_depth = 1.0_um, .chip = 1000.0_N_per_mm2};

TEST(EdgeLaw, ThickChipTakesTheWholeEdgeForceAndTheChipForce) {
    EXPECT_NEAR(force_per_width(50.0_um, textbook), 60.0_N_per_mm, 1e-9 /* e^-50 is nothing */);
}

TEST(EdgeLaw, NoChipNoForce) { EXPECT_EQ(force_per_width(0.0, textbook), 0.0); }

TEST(EdgeLaw, WithdrawingTakesNoForce) { EXPECT_EQ(force_per_width(-1.0_mm, textbook), 0.0); }

TEST(EdgeLaw, RisesWithTheChip) {
    for (double t = 0.0; t < 200.0_um; t += 0.1_um)
        EXPECT_LT(force_per_width(t, textbook), force_per_width(t + 0.1_um, textbook));
}

TEST(EdgeLaw, HalfTheDensityResistsAQuarter) { EXPECT_DOUBLE_EQ(resistance_of_density(900.0, 1800.0), 0.25); }

TEST(CrushingPressure, OfSpongyAndOfWholeBone) {
    EXPECT_NEAR(crushing_pressure(300.0), 6.12e6, 1.0);
    EXPECT_NEAR(crushing_pressure(1850.0), 232.73e6, 1e3);
}

}  // namespace
}  // namespace kerf::drilling
