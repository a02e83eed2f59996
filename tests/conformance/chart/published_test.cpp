// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "conformance/chart/published.h"

#include <gtest/gtest.h>

#include "kerf/units.hpp"
#include "tests/bench/as_printed/printed_rig.h"

namespace kerf::chart {
namespace {

using namespace literals;

Prediction prediction(const char* law, const char* quantity, double speed) {
    for (const Prediction& p : predictions(test::shared_law()))
        if (p.law == law && p.quantity == quantity && p.speed == speed && p.tissue == "human femur") return p;
    return {};
}

TEST(Published, AProportionalLawMissesTheThirdSpeedByNearlyFourSD) {  // B1-a
    const Prediction thrust = prediction("proportional", "thrust", 1500.0_rpm);
    EXPECT_NEAR(thrust.predicted, 132.0, 0.5);
    EXPECT_NEAR(thrust.off_in_sd(), -3.9, 0.05);
    EXPECT_NEAR(prediction("proportional", "torque", 1500.0_rpm).off_in_sd(), -1.0, 0.05);
}

TEST(Published, EdgeAndChipMeetTheMeanBetween) {  // B1-a
    EXPECT_NEAR(prediction("edge + chip", "thrust", 1250.0_rpm).off_in_sd(), 0.32, 0.01);
    EXPECT_NEAR(prediction("edge + chip", "torque", 1250.0_rpm).off_in_sd(), 0.05, 0.01);
}

TEST(Published, ThePluginsLawIsTheLeastSquaresLineThroughAllThree) {
    const double feed[] = {0.12, 0.096, 0.08}, unit = 1e3;
    for (const double f : feed) {
        EXPECT_NEAR(shared_law_at(test::shared_law(), f * 1e-3, false), 129.1 + 567.4 * f, 0.2);
        EXPECT_NEAR(unit * shared_law_at(test::shared_law(), f * 1e-3, true), 47.4 + 1155.0 * f, 0.2);
    }
}

TEST(Published, EveryLawIsCalibratedOnAsFewMeansAsItHasConstants) {
    for (const PublishedSeries& series : published_series())
        for (const FeedLaw& law : fitted_laws(series, false)) {
            EXPECT_EQ(law.calibrated_on.size(), std::string(law.name) == "proportional" ? 1u : 2u);
            for (const std::size_t i : law.calibrated_on)
                if (series.feed_rate > 0.0) {
                    EXPECT_NEAR(law.at(series.feed(series.means[i])), series.means[i].thrust, 1e-9) << law.name;
                }
        }
}

TEST(Published, ChecksSayWhatPassesAndWhatDoesNot) {
    int failed = 0;
    for (const Check& check : published_checks(test::shared_law(), awl_ways())) {
        EXPECT_FALSE(check.found.empty()) << check.what;
        if (check.id == "B1-d") {
            EXPECT_TRUE(check.passes);
        }
        if (check.what.find("proportional") == 0 && check.what.find("thrust") != std::string::npos) {
            EXPECT_FALSE(check.passes);
        }
        failed += check.passes ? 0 : 1;
    }
    EXPECT_GE(failed, 1);
}

TEST(Published, AnAwlsPushLiesAboutWhatWasMeasured) {
    const std::vector<AwlWay> ways = awl_ways();
    ASSERT_EQ(ways.size(), 1 + std::size(pedicle_walls));
    // Along the axis what 4 mm and 30 degrees crush in 0.25 g/cm3
    const double safe = 68e6 * 0.25 * 0.25 * pi * 4e-6 * (1.0 + 0.3 / std::tan(0.2618));
    EXPECT_NEAR(ways[0].most(), safe, 1.0);
    // Besides that a wall bears by the square of its thickness and of its bone: found in one, told of the others.
    const auto in_wall = [&](const AwlWay& way) { return way.most() - safe; };
    const auto by_squares = [](const PedicleWall& wall) { return wall.thickness * wall.thickness * wall.bone() * wall.bone(); };
    for (std::size_t i = 1; i < ways.size(); ++i)
        EXPECT_NEAR(in_wall(ways[i]) / in_wall(ways[1]), by_squares(*ways[i].wall) / by_squares(*ways[1].wall), 0.1 * by_squares(*ways[i].wall) / by_squares(*ways[1].wall)) << ways[i].wall->name();
    double least = 1e300, most = 0.0;
    for (std::size_t i = 1; i < ways.size(); ++i) least = std::min(least, ways[i].most()), most = std::max(most, ways[i].most());
    EXPECT_LT(least, measured_breach_push[1]) << "the weakest wall bears no more than was measured in the mean";
    EXPECT_GT(most, measured_breach_push[1]) << "the strongest more";
}

}  // namespace
}  // namespace kerf::chart
