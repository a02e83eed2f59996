// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/stability/cutting.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/studies/stability/found_tool.h"

namespace kerf::stability {
namespace {

TEST(Cutting, TheLargestSampledDamperIsThatOfTheory) {
    const PortSettings at_once{.mass = 0.2}, one_tick_late{.mass = 0.2, .delay = 1};
    EXPECT_NEAR(largest_damper(at_once, 5.0) / (2.0 * 0.2 / 1e-3), 1.0, 0.02);
    EXPECT_NEAR(largest_damper(one_tick_late, 5.0) / (2.0 * 0.2 / 1e-3), 0.41, 0.01);
}

TEST(Cutting, TheLawChattersAtTheDevicesRateAndIsQuietWhenSolved) {
    std::vector<Finding> found;
    check_cutting(only("premium-1.5-6dof", test_hands[2], 0), the_drill(),
                  [&](const Finding& f) { found.push_back(f); });
    ASSERT_EQ(found.size(), 3u);
    EXPECT_EQ(found[0].outcome, Outcome::fail) << "as a damper: " << found[0].measured;
    EXPECT_EQ(found[1].outcome, Outcome::fail) << "directly: " << found[1].measured;
    EXPECT_EQ(found[2].outcome, Outcome::pass) << "solved: " << found[2].measured;
    EXPECT_EQ(found[2].method, Method::kerf);
    EXPECT_NE(found[2].measured.find(" mm deep"), std::string::npos) << "it stays in the block: " << found[2].measured;
}

TEST(Cutting, WhatFliesOutOfTheBlockIsNotJudgedAsIfItWereInIt) {
    std::vector<Finding> found;
    check_cutting(only("premium-1.5-6dof", no_hand, 0), the_drill(), [&](const Finding& f) { found.push_back(f); });
    ASSERT_EQ(found.size(), 3u);
    EXPECT_NE(found[1].measured.find("the block after"), std::string::npos) << "directly: " << found[1].measured;
    EXPECT_EQ(found[2].outcome, Outcome::pass) << "solved: " << found[2].measured;
}

TEST(Cutting, APluginThatIsNotThereIsSaid) {
    std::string error;
    EXPECT_FALSE(find_tool(test::plugins(), "kerf.none", error));
    EXPECT_NE(error.find("`kerf.none`"), std::string::npos) << error;
}

}  // namespace
}  // namespace kerf::stability
