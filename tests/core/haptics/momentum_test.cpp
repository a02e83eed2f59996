// SPDX-License-Identifier: Apache-2.0
// Momentum and energy of a tool about its tip, with round numbers.
#include <gtest/gtest.h>

#include <cstddef>

#include "core/haptics/law/inertia.h"

namespace kerf {
namespace {

/// 2 kg with their centre 100 mm behind the tip, 50 mm of gyration: 2 (0.1² + 0.05²) = 0.025 kg·m² about the tip.
constexpr Inertia tool{.mass = 2.0, .centre_z = -0.1, .gyration = 0.05};

void expect_near(const Vec6& is, const Vec6& wanted) {
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(is[i], wanted[i], 1e-15) << i;
}

TEST(Momentum, OfAShiftActsAtTheCentre) {
    expect_near(momentum(tool, {3.0, 0, 0, 0, 0, 0}), {6.0, 0, 0, 0, -0.6, 0});  // r × p = (0, 0, −0.1) × (6, 0, 0)
    expect_near(momentum(tool, {0, 3.0, 0, 0, 0, 0}), {0, 6.0, 0, 0.6, 0, 0});
}

TEST(Momentum, OfATurnHasTheShiftOfItsCentre) {
    expect_near(momentum(tool, {0, 0, 0, 4.0, 0, 0}), {0, 0.8, 0, 0.1, 0, 0});  // ω × r = (0, 0.4, 0) m/s
    expect_near(momentum(tool, {0, 0, 0, 0, 4.0, 0}), {-0.8, 0, 0, 0, 0.1, 0});
}

TEST(Momentum, AlongAndAboutTheAxisIsNone) { expect_near(momentum(tool, {0, 0, 5.0, 0, 0, 5.0}), {}); }

TEST(KineticEnergy, IsThatOfTheCentreAndOfTheTurnAboutIt) {
    // The centre moves by 3 − 0.4 and 1 + 0.2 m/s
    EXPECT_NEAR(kinetic_energy(tool, {3.0, 1.0, 7.0, 2.0, 4.0, 9.0}),
                0.5 * 2.0 * (2.6 * 2.6 + 1.2 * 1.2) + 0.5 * 2.0 * 0.0025 * (4.0 + 16.0), 1e-12);
}

}  // namespace
}  // namespace kerf
