// SPDX-License-Identifier: Apache-2.0
#include "kerf/outline.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "kerf/figure.hpp"
#include "kerf/units.hpp"

namespace kerf {
namespace {

using namespace literals;

/// An outline as the host receives it.
struct Written {
    std::array<kerf_profile_point, Outline::capacity> point{};
    kerf_tool_shape shape{};
    kerf_status status;

    explicit Written(const Outline& outline, std::uint32_t room = Outline::capacity) {
        shape.profile = point.data();
        shape.profile_capacity = room;
        status = outline.write(shape);
    }
};

TEST(Outline, WritesPointsInOrder) {
    const Written rod(revolution({{0, 0}, {-2_mm, 1_mm}}).to(-9_mm, 1_mm).gripped_at(-20_mm));
    ASSERT_EQ(rod.status, KERF_OK);
    ASSERT_EQ(rod.shape.profile_count, 3u);
    EXPECT_EQ(rod.point[1].z, -2_mm);
    EXPECT_EQ(rod.point[1].radius, 1_mm);
    EXPECT_EQ(rod.point[2].z, -9_mm);
    EXPECT_EQ(rod.shape.grip_z, -20_mm);
    EXPECT_EQ(rod.shape.kind, KERF_SOLID_REVOLUTION);
}

TEST(Outline, CutsNothingUnlessAsked) {
    EXPECT_EQ(Written(revolution({{0, 0}, {-2_mm, 1_mm}})).shape.cutting_count, 0u);
    EXPECT_EQ(Written(revolution({{0, 0}, {-2_mm, 1_mm}}).cuts().to(-9_mm, 1_mm)).shape.cutting_count, 2u);
}

TEST(Outline, BeginsToCutWhereASafePartEnds) {
    const Written reamer(revolution({{0, 0}, {-1_mm, 1_mm}, {-5_mm, 1_mm}})
                             .safe()
                             .to(-6_mm, 2_mm)
                             .to(-9_mm, 2_mm)
                             .cuts()
                             .to(-20_mm, 2_mm));
    EXPECT_EQ(reamer.shape.cutting_first, 2u);
    EXPECT_EQ(reamer.shape.cutting_count, 3u);
    EXPECT_EQ(reamer.shape.profile_count, 6u);
    EXPECT_EQ(Written(revolution({{0, 0}, {-2_mm, 1_mm}}).safe()).shape.cutting_count, 0u) << "it cuts nothing";
}

TEST(Outline, CutsInSeveralParts) {
    const Written heads(revolution({{0, 0}, {-2_mm, 2_mm}})
                            .cuts()
                            .to(-3_mm, 1_mm)
                            .to(-6_mm, 1_mm)
                            .safe()
                            .to(-8_mm, 3_mm)
                            .cuts()
                            .to(-20_mm, 1_mm));
    EXPECT_EQ(heads.shape.cutting_first, 0u);
    EXPECT_EQ(heads.shape.cutting_count, 5u);
    ASSERT_EQ(heads.shape.gap_count, 1u);
    EXPECT_EQ(heads.shape.gap[0].first, 1u);
    EXPECT_EQ(heads.shape.gap[0].last, 3u);
    const Written once(revolution({{0, 0}, {-2_mm, 2_mm}}).cuts().to(-6_mm, 1_mm).safe());
    EXPECT_EQ(once.shape.gap_count, 0u) << "what is safe at the end is no gap";
    EXPECT_EQ(once.shape.cutting_count, 2u);
}

TEST(Outline, WritesTheBoreOfAHollowTool) {
    EXPECT_EQ(Written(revolution({{0, 4_mm}, {-9_mm, 4_mm}}).cuts().hollow(3_mm)).shape.bore, 3_mm);
    EXPECT_EQ(Written(revolution({{0, 4_mm}, {-9_mm, 4_mm}}).cuts()).shape.bore, 0.0);
}

TEST(Outline, WritesTheThreadOfWhatStays) {
    EXPECT_EQ(Written(revolution({{0, 0}, {-2_mm, 1_mm}}).cuts()).shape.thread_radius, 0.0);
    const Written screw(revolution({{0, 0}, {-2_mm, 1_mm}}).cuts().threaded({3_mm, 2_mm}).stays());
    EXPECT_EQ(screw.shape.thread_radius, 3_mm);
    EXPECT_EQ(screw.shape.thread_lead, 2_mm);
    EXPECT_EQ(screw.shape.stay_count, 2u);
    EXPECT_EQ(screw.shape.thread_count, 2u);
}

TEST(Outline, BallLiesOnItsSphereBehindTheEquatorToo) {
    const Written ball(revolution().ball(-3_mm, 3_mm, 150_deg, 10));
    ASSERT_EQ(ball.shape.profile_count, 11u);
    EXPECT_EQ(ball.point[0].z, 0.0);
    for (std::size_t i = 0; i < 11; ++i)
        EXPECT_NEAR(std::hypot(ball.point[i].z + 3_mm, ball.point[i].radius), 3_mm, 1e-15) << i;
    EXPECT_NEAR(ball.point[10].radius, 1.5_mm, 1e-15) << "sin 150 deg";
}

TEST(Outline, WritesBladeAndWeight) {
    const Written blade(
        prism(1.2_mm, 1.0_mm).to(0, 8_mm).to(-5_mm, 8_mm).weighs({.mass = 0.4, .centre_z = -0.1, .gyration = 0.05}));
    EXPECT_EQ(blade.shape.kind, KERF_SOLID_PRISM);
    EXPECT_EQ(blade.shape.kerf, 1.2_mm);
    EXPECT_EQ(blade.shape.thickness, 1.0_mm);
    EXPECT_EQ(blade.shape.mass, 0.4);
    EXPECT_EQ(blade.shape.centre_z, -0.1);
    EXPECT_EQ(blade.shape.gyration, 0.05);
}

TEST(Outline, RefusesMorePointsThanThereIsRoomFor) {
    Outline longer = revolution();
    for (std::size_t i = 0; i <= Outline::capacity; ++i) longer.to(-static_cast<double>(i) * 1e-3, 1e-3);
    EXPECT_EQ(Written(longer).status, KERF_CAPACITY);
    EXPECT_EQ(Written(revolution({{0, 0}, {-1_mm, 1_mm}, {-2_mm, 1_mm}}), 2).status, KERF_CAPACITY);
}

TEST(Refusal, JoinsItsPieces) {
    const Written refused(refuse("`a` is ", in_mm(0.003), std::string("; it needs "), in_mm(0.004), "."));
    EXPECT_EQ(refused.status, KERF_OUT_OF_RANGE);
    EXPECT_STREQ(refused.shape.refusal, "`a` is 3 mm; it needs 4 mm.");
}

TEST(Refusal, IsCutOffWhereItIsTooLong) {
    const Written refused(refuse(std::string(200, 'a'), std::string(200, 'b'), "c"));
    EXPECT_EQ(std::string(refused.shape.refusal), std::string(200, 'a') + std::string(39, 'b'));
}

}  // namespace
}  // namespace kerf
