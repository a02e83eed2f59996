// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/drill/methods.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "core/haptics/loop/coupling.h"
#include "kerf/units.hpp"
#include "studies/chart/drill/standing.h"
#include "studies/stability/port.h"
#include "tests/studies/papers/as_printed/printed_rig.h"

namespace kerf::chart {
namespace {

using namespace literals;
using test::method;

Measured on_the_slab(const std::string& id, double spacing, int points = 31) {
    return measure(method(id), slab_scene(0.0), test::shared_law(), {spacing, points, {}}, 1);
}
bool fails(const Standing& standing, const std::string& id) {
    return std::find(standing.fails.begin(), standing.fails.end(), id) != standing.fails.end();
}
Standing standing(const std::string& id, double spacing = 0.5_mm) {
    return standing_of(method(id), test::shared_law(), {spacing, 31, {}});
}

TEST(Methods, AFinerGridIsNearerToTheExactForce) {
    for (const char* id : {"M2", "M3", "M5"})
        EXPECT_LT(on_the_slab(id, 0.25_mm).force_error, 0.7 * on_the_slab(id, 1.0_mm).force_error) << id;
}

TEST(Methods, OnBinaryVoxelsMorePointsDoNotHelp) {  // finding 4 of C.9
    const double few = on_the_slab("M2", 0.5_mm, 31).force_error, many = on_the_slab("M2", 0.5_mm, 100).force_error;
    EXPECT_NEAR(many, few, 0.1 * few);
}

TEST(Methods, BordersWithinAVoxelAreWorthAFinerGrid) {
    EXPECT_LT(on_the_slab("M4", 0.5_mm, 16).force_error, on_the_slab("M2", 0.1_mm, 31).force_error);
}

TEST(Methods, TheLipIntegralComesToTheExactForceAsNodesAreAdded) {
    const double few = on_the_slab("M8", 0.5_mm, 4).force_error, many = on_the_slab("M8", 0.5_mm, 62).force_error;
    EXPECT_LT(many, 0.1 * few);
    EXPECT_LT(many, 1e-3);
}

TEST(Methods, WhatIsSolvedFeelsTheLawOfItsOwnMotion) {
    const Measured solved = on_the_slab("M9", 0.5_mm);
    EXPECT_LT(solved.force_error, 0.01);
    EXPECT_LT(solved.volume_error, 0.01);
}

TEST(Methods, HeldAgainstWhatTheSameHandFeelsElsewhere) {
    const Scene scene = slab_scene(0.0);
    const Method kerf = method("M9");
    const Fineness coarse{1.0_mm, 31, {}};
    // The same run once more: measure() shifts the grid first of all so.
    std::vector<Felt> led = led_by_hand(kerf, scene, {1.0_mm, 31, {0.31, 0.17, 0.73}});
    const Measured same = measure(kerf, scene, test::shared_law(), coarse, 1, led);
    EXPECT_EQ(same.same_hand, 0.0);
    EXPECT_EQ(same.same_hand_turn, 0.0);
    EXPECT_EQ(same.apart, 0.0);
    // Twice as much in one tick, two thirds in the next: over a turn of 60 ticks four thirds.
    for (std::size_t t = 0; t < led.size(); ++t) {
        led[t].wrench[2] *= t % 2 == 0 ? 2.0 : 2.0 / 3.0;
        led[t].from.position.x += 0.3_mm;
    }
    const Measured other = measure(kerf, scene, test::shared_law(), coarse, 1, led);
    EXPECT_NEAR(other.same_hand, std::sqrt((1.0 + 1.0 / 9.0) / (4.0 + 4.0 / 9.0)), 0.01);
    EXPECT_NEAR(other.same_hand_turn, 0.25, 0.01);
    EXPECT_NEAR(other.apart, 0.3_mm, 1e-9);
}

TEST(Methods, OneStepOfASampledLipIsOnePoint) {  // 02-18
    EXPECT_LT(on_the_slab("M4", 0.25_mm, 31).peak_step, 1.0 / 31.0);
    EXPECT_GT(on_the_slab("M2", 0.5_mm, 8).peak_step, 1.0 / 31.0);
}

TEST(Methods, AsPrintedTheLargestForceIsOneThatShouldNotBe) {
    const Measured printed = on_the_slab("000", 0.5_mm);
    EXPECT_GT(printed.off_lateral, printed.reference)
        << "[N] across the shaft of a drill that goes straight into a flat slab";
    EXPECT_GT(printed.force_error, 1.0);
}

TEST(Methods, TheWayOfThePapersShakesTheHandAndKerfDoesNot) {  // S-01
    EXPECT_TRUE(fails(standing("M2"), "S-01"));
    EXPECT_TRUE(fails(standing("000"), "S-01"));
    EXPECT_FALSE(fails(standing("M9"), "S-01"));
    const Standing kerf = standing("M9", 0.25_mm);
    EXPECT_TRUE(kerf.fails.empty()) << kerf.told;
}

TEST(Methods, EachFailsWhatItMust) {
    EXPECT_TRUE(fails(standing("M1"), "S-07")) << "counts points";
    EXPECT_TRUE(fails(standing("M2"), "S-12")) << "bone goes when all is over";
    EXPECT_TRUE(fails(standing("M6"), "P9")) << "has no feed";
    EXPECT_TRUE(fails(standing("000"), "S-19")) << "divides by the speed";
}

TEST(Methods, ASampledSpringOnABareDeviceIsSofterThanTheCoupling) {
    const DeviceRecord& device = *find_device("premium-1.5-6dof");
    const double b = stability::port_of(device, stability::no_hand, 0).viscosity, half_a_tick = 0.5e-3;
    const double sampled = stiffest(method("M2"), test::shared_law()),
                 solved = stiffest(method("M9"), test::shared_law());
    EXPECT_NEAR(sampled / (b / half_a_tick), 1.0, 0.03) << "b over half a tick";
    EXPECT_GT(solved, (b + gains_for(device, 1.0).damping) / half_a_tick)
        << "with the coupling's damping, and what else takes energy";
}

TEST(Methods, TheSameRunGivesTheSameFigures) {
    const Measured once = on_the_slab("M4", 0.5_mm), again = on_the_slab("M4", 0.5_mm);
    EXPECT_EQ(once.force_error, again.force_error);
    EXPECT_EQ(once.volume_error, again.volume_error);
    EXPECT_EQ(once.peak_step, again.peak_step);
}

TEST(Methods, WithoutThePapersTheirsAreLeftOut) {
    const PluginRegistry none;
    for (const Method& one : all_methods({&test::own_plugins(), &none}, test::shared_law(), true))
        EXPECT_FALSE(one.is_as_printed) << one.id;
    std::string error;
    EXPECT_FALSE(shared_law({&none, &none}, error).has_value());
    EXPECT_NE(error.find("kerf.drilling"), std::string::npos);
}

}  // namespace
}  // namespace kerf::chart
