// SPDX-License-Identifier: Apache-2.0
#include "kerf/exact_math.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace kerf {
namespace {

TEST(ExactMath, ExpIsWithinTwoUlpOfTheLibrarys) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> x(-700.0, 700.0), small(-1.0, 1.0);
    for (int i = 0; i < 100000; ++i)
        for (const double at : {x(random), small(random)}) {
            const double want = std::exp(at);
            ASSERT_NEAR(exp_exact(at), want, 2.0 * std::numeric_limits<double>::epsilon() * want) << at;
        }
    EXPECT_EQ(exp_exact(0.0), 1.0);
    EXPECT_EQ(exp_exact(-1e9), 0.0);
    EXPECT_EQ(exp_exact(std::nan("")), 0.0);
    EXPECT_EQ(exp_exact(1e9), std::numeric_limits<double>::max());
}

TEST(ExactMath, SineAndCosineAreTheLibrarys) {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> x(-1e6, 1e6), small(-7.0, 7.0);
    for (int i = 0; i < 100000; ++i)
        for (const double at : {x(random), small(random)}) {
            const SinCos got = sin_cos_exact(at);
            ASSERT_NEAR(got.sin, std::sin(at), 5e-16 + 1e-16 * std::abs(at) * 1e-3) << at;
            ASSERT_NEAR(got.cos, std::cos(at), 5e-16 + 1e-16 * std::abs(at) * 1e-3) << at;
        }
}

}  // namespace
}  // namespace kerf
