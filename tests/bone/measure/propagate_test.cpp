// SPDX-License-Identifier: Apache-2.0
#include "bone/measure/propagate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

namespace kerf::bone {
namespace {

/// Propagates through a function without a fold before it.
template <class ValueAt>
std::optional<Measured> propagate(std::span<const double> uncertainties, ValueAt value_at) {
    return bone::propagate(
        uncertainties,
        [&](std::span<const double> shifts) -> std::optional<TracedValue> {
            const std::optional<double> value = value_at(shifts);
            if (!value) return std::nullopt;
            return TracedValue{*value, {*value}};
        },
        [](std::span<const double> operands) { return std::optional(operands[0]); });
}

TEST(Propagate, AddsIndependentInputsInQuadrature) {
    constexpr std::array<double, 2> u{3.0, 4.0};
    const auto sum = propagate(u, [](std::span<const double> x) { return std::optional(7.0 + x[0] - x[1]); });
    ASSERT_TRUE(sum);
    EXPECT_EQ(sum->value, 7.0);
    EXPECT_NEAR(sum->uncertainty, 5.0, 1e-12);
}

TEST(Propagate, CancelsAnInputThatCountsTwice) {
    constexpr std::array<double, 1> u{0.1};
    const auto zero =
        propagate(u, [](std::span<const double> x) { return std::optional((2.0 + x[0]) - (1.0 + x[0])); });
    ASSERT_TRUE(zero);
    EXPECT_NEAR(zero->uncertainty, 0.0, 1e-12);
}

TEST(Propagate, AgreesWithTheDerivativeOfACurve) {
    constexpr std::array<double, 1> u{1e-3};
    const auto root = propagate(u, [](std::span<const double> x) { return std::optional(std::sqrt(4.0 + x[0])); });
    ASSERT_TRUE(root);
    EXPECT_NEAR(root->uncertainty, 0.25e-3, 1e-9 /* terms of third order */);
}

TEST(Propagate, TakesTheSideThatExists) {
    constexpr std::array<double, 1> u{1.0};
    const auto one =
        propagate(u, [](std::span<const double> x) { return x[0] < 0.0 ? std::nullopt : std::optional(2.0 * x[0]); });
    ASSERT_TRUE(one);
    EXPECT_NEAR(one->uncertainty, 2.0, 1e-12);
    EXPECT_FALSE(
        propagate(u, [](std::span<const double> x) { return x[0] != 0.0 ? std::nullopt : std::optional(1.0); }));
}

/// Propagates one operand, the sum of the inputs and `at`, through `last`.
template <class Last>
std::optional<Measured> propagate_sum(std::span<const double> uncertainties, double at, Last last) {
    return bone::propagate(
        uncertainties,
        [&](std::span<const double> shifts) -> std::optional<TracedValue> {
            double sum = at;
            for (const double shift : shifts) sum += shift;
            return TracedValue{last(sum).value_or(0.0), {sum}};
        },
        [&](std::span<const double> operands) { return last(operands[0]); });
}

TEST(Propagate, SpreadsAtAFold) {
    constexpr std::array<double, 2> u{3.0, 4.0};
    const auto absolute = [](double x) { return std::optional(std::abs(x)); };
    EXPECT_NEAR(propagate_sum(u, 0.0, absolute)->uncertainty, 5.0, 0.25 /* of 1024 draws */);
    EXPECT_EQ(propagate_sum(u, 100.0, absolute)->uncertainty, 5.0) << "no draw crosses the fold";
    EXPECT_NEAR(propagate_sum(u, 0.0, [](double x) { return std::optional(std::min(x, -x)); })->uncertainty, 5.0, 0.25);
}

TEST(Propagate, KeepsTheFirstOrderWhereFewDrawsHaveAValue) {
    constexpr std::array<double, 1> u{1.0};
    const auto rarely = [](double x) {
        return std::abs(x) < 1.1 && std::abs(x) > 0.9 ? std::optional(x) : std::nullopt;
    };
    const auto found = propagate_sum(u, 0.0, rarely);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->uncertainty, 1.0, 1e-12);
}

TEST(Propagate, AveragesOverTheDrawsThatHaveAValue) {
    // Draws are even between ±√3; x² from −0.5 on has a mean square of (√3⁵ + 0.5⁵) / (5 (√3 + 0.5)) = 1.3995
    constexpr std::array<double, 1> u{1.0};
    const auto found = propagate_sum(u, 0.0, [](double x) { return x > -0.5 ? std::optional(x * x) : std::nullopt; });
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->uncertainty, std::sqrt(1.3995), 0.06 /* of two thirds of 1024 draws */);
}

TEST(Propagate, ToleranceIsAnEvenlySpreadInterval) {
    EXPECT_NEAR(standard_uncertainty_of(1.5e-3), 1.5e-3 / std::sqrt(3.0), 1e-15);
}

}  // namespace
}  // namespace kerf::bone
