// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/stability/criterion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

#include "kerf/units.hpp"

namespace kerf::stability {
namespace {

Trace swinging(double hertz, double newtons, double metres) {
    Trace trace;
    for (int i = 0; i < 2000; ++i) {
        const double s = std::sin(2.0 * pi * hertz * i * trace.period + 0.3);
        trace.force.push_back(2.0 + newtons * s);
        trace.depth.push_back(metres * s);
    }
    return trace;
}

TEST(Criterion, CountsPeakToPeakInHold) {
    EXPECT_NEAR(judge(swinging(10.0, 0.0, 1e-5), 1e-5, false).counts, 2.0, 0.01);
    EXPECT_TRUE(judge(swinging(10.0, 0.0, 1e-5), 1e-5, false).is_stable());
    EXPECT_FALSE(judge(swinging(10.0, 0.0, 2e-5), 1e-5, false).is_stable());
}

TEST(Criterion, AnAdvanceIsNoSwing) {
    Trace trace = swinging(100.0, 0.0, 1e-5);
    for (std::size_t i = 0; i < trace.depth.size(); ++i) trace.depth[i] += 2e-6 * static_cast<double>(i);
    EXPECT_GT(judge(trace, 1e-5, false).counts, 100.0);
    EXPECT_NEAR(judge(trace, 1e-5, true).counts, 2.0, 0.2 /* a line takes a little of any sine */);
}

TEST(Criterion, AlternationCountsAboveFiftyHertzAndAboveItsForce) {
    EXPECT_GT(judge(swinging(60.0, 0.1, 0.0), 1e-5, false).turns, 10);
    EXPECT_LE(judge(swinging(40.0, 0.1, 0.0), 1e-5, false).turns, 10);
    EXPECT_EQ(judge(swinging(200.0, 0.02, 0.0), 1e-5, false).turns, 0);
}

TEST(Criterion, WhatWasSpentOnBoneIsNotCredited) {
    PortEnergy energy;
    for (int i = 0; i < 1000; ++i) energy.see(2.0, 1e-5, 1e-3);  // 20 mJ of drilling, 1 mJ in the spring
    for (int i = 0; i < 100; ++i) energy.see(2.0, -1e-5, 1e-3);  // 2 mJ come out
    EXPECT_NEAR(energy.least(), -1e-3, 1e-12);
}

}  // namespace
}  // namespace kerf::stability
