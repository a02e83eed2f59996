// SPDX-License-Identifier: Apache-2.0
#include "kerf/edge_law.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kerf/units.hpp"

namespace kerf {
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

TEST(EdgeLaw, BuildsUpByTwoThirdsAtTheEdgeDepth) {
    EXPECT_NEAR(force_per_width(1.0_um, textbook), 10.0_N_per_mm * (1.0 - std::exp(-1.0)) + 1.0_N_per_mm, 1e-9);
}

TEST(EdgeLaw, AddsTissuesByWeightTimesEngagement) {
    const kerf_bone_sample half{
        .engagement = 0.5, .gap = 0.0, .weight = {0.25, 0.75}, .density = {900.0, 1800.0}, .body = 0, .reserved = 0};
    EXPECT_DOUBLE_EQ(resistance(half, 2, 1800.0), 0.5 * (0.25 * 0.25 + 0.75));
    EXPECT_DOUBLE_EQ(resistance(half, 1, 1800.0), 0.5 * 0.25 * 0.25) << "of one tissue";
}

TEST(EdgeLaw, ResistsNothingInAir) {
    const kerf_bone_sample air{
        .engagement = 0.0, .gap = 0.0, .weight = {1.0}, .density = {1800.0}, .body = -1, .reserved = 0};
    EXPECT_EQ(resistance(air, 1, 1800.0), 0.0);
}

}  // namespace
}  // namespace kerf
