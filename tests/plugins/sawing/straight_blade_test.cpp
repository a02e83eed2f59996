// SPDX-License-Identifier: Apache-2.0
#include "plugins/sawing/straight_blade.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <map>
#include <string>

#include "plugins/sawing/reciprocating_force.h"
#include "tests/support/saw_rig.h"

namespace kerf::sawing {
namespace {

using namespace literals;

StraightBlade blade(const std::map<std::string, double>& set = {}) {
    return value_of<ReciprocatingBlade>(test::reciprocating_saw(set).tool_parameters).blade();
}
std::string refusal(const std::map<std::string, double>& set) {
    ToolOutline outline;
    std::string why;
    return outline_of(test::reciprocating_saw(set), outline, why) ? "" : why;
}

TEST(StraightBlade, HasAsManyTeethAsFit) {
    EXPECT_EQ(blade({{"blade_length", 50.0_mm}, {"tooth_pitch", 1.41_mm}}).count(), 35u) << "50 / 1.41 = 35.46";
    EXPECT_EQ(blade({{"blade_length", 30.0_mm}, {"tooth_pitch", 0.6_mm}}).count(), 50u) << "and all of whole pitches";
}

TEST(StraightBlade, TeethLieInARowAPitchApart) {
    const StraightBlade b = blade({{"blade_length", 10.0_mm}, {"tooth_pitch", 2.0_mm}});
    for (const double swing : {0.0_mm, 1.5_mm, -1.5_mm}) {
        const Teeth teeth = teeth_of(b, swing);
        ASSERT_EQ(teeth.count, 5u);
        for (std::size_t i = 0; i < teeth.count; ++i) {
            const Tooth& t = teeth.tooth[i];
            EXPECT_NEAR(t.tip.x, (static_cast<double>(i) - 2.0) * 2.0_mm + swing, 1e-15);
            EXPECT_EQ(t.tip.z, 0.0);
            EXPECT_TRUE((t.normal == Vec3{0, 0, 1})) << "teeth advance along the axis of the feed";
            EXPECT_TRUE((t.along == Vec3{1, 0, 0})) << "and move along the blade";
            EXPECT_EQ(t.side, i % 2 == 0 ? 1.0 : -1.0);
            EXPECT_GT(t.side * t.tip.y, 0.0) << "set by turns";
        }
    }
}

TEST(StraightBlade, SweepsItsRowLengthenedByTheStroke) {
    const ToolSetup setup = test::reciprocating_saw({{"blade_length", 20.0_mm}, {"tooth_pitch", 2.0_mm}});
    const ToolOutline outline = test::outline(setup);
    ASSERT_TRUE(outline.cutting.is_prism());
    EXPECT_NEAR(outline.cutting.largest_radius(), 10.0_mm + 1.5_mm, 1e-15) << "half a stroke of 3 mm at either end";
    EXPECT_NEAR(outline.cutting.thickness(), 1.0_mm, 1e-15) << "the kerf";
    EXPECT_NEAR(outline.whole.thickness(), 0.8_mm, 1e-15) << "the blade behind it";
    // Only the toothed strip removes bone: 1 mm deep
    EXPECT_LT(outline.cutting.distance({0, 0, -0.5_mm}), 0.0);
    EXPECT_GT(outline.cutting.distance({0, 0, -1.5_mm}), 0.0);
    EXPECT_LT(outline.whole.distance({0, 0, -9.5_mm}), 0.0) << "the back edge is 10 mm behind the tips";
    EXPECT_GT(outline.whole.distance({0, 0, -10.5_mm}), 0.0);
}

TEST(StraightBlade, PairStandsForAPitchOfTheFront) {
    const StraightBlade b = blade();
    const Tooth tooth = teeth_of(b, 0.0).tooth[3];
    const auto pair = b.points_around(tooth, 0.25 * b.pitch);
    EXPECT_NEAR(pair[1].x - pair[0].x, 0.5 * b.pitch, 1e-15);
    EXPECT_NEAR(0.5 * (pair[0].x + pair[1].x), tooth.tip.x, 1e-15);
}

// 1/k = l³/(3 E I) + a² l/(G J) + 1/k_bone at the middle of 50 × 10 × 0.8 mm: l = 25 mm, I = 0.4267 mm⁴, J = 1.7067 mm⁴
TEST(StraightBlade, SidesBendAndTwistBeforeTheBone) {
    kerf_bone_query query{};
    query.reach = 1.0_mm;
    const StraightBlade b = blade();
    const TouchingPoints points = touching_points(b, defaults_of<ReciprocatingCutting>(), BoneQuery(query), true);
    const double bending = 15.625e-6 / (3.0 * 193e9 * 0.42667e-12), twist = 25e-3 / (193e9 / 2.6 * 1.70667e-12),
                 bone = 1.0 / 500e3;
    int checked = 0;
    for (std::size_t i = 0; i < points.side_count; ++i) {
        const std::size_t at = points.of_sides[i].index;
        const Vec3 p = points.all.at(at);
        if (std::abs(p.x) > 1e-9) continue;
        const double arm = p.z + 5.0_mm;
        EXPECT_NEAR(1.0 / points.all.stiffness(at) / (bending + arm * arm * twist + bone), 1.0, 1e-4) << p.z;
        EXPECT_NEAR(std::abs(p.y), 0.4_mm, 1e-15);
        EXPECT_EQ(points.all.slot(at), (p.y > 0.0 ? 3u : 5u) + (p.z < -5.0_mm ? 1u : 0u)) << "both edges of both sides";
        EXPECT_NEAR(p.z + 1.0_mm, -points.of_sides[i].behind, 1e-15) << "behind the roots of the teeth";
        ++checked;
    }
    EXPECT_EQ(checked, 2 * 4) << "rows at 0.25, 3 and 7 mm and at the back edge, on both sides";
}

TEST(StraightBlade, RefusesWhatIsNoBlade) {
    EXPECT_NE(refusal({{"blade_length", 5.0_mm}, {"tooth_pitch", 0.3_mm}, {"tooth_height", 5.0_mm}}), "");
    EXPECT_NE(refusal({{"blade_length", 120.0_mm}}).find("85 teeth of `tooth_pitch` 1.41 mm; at most 64"),
              std::string::npos)
        << refusal({{"blade_length", 120.0_mm}});
    EXPECT_NE(refusal({{"blade_height", 2.0_mm}}).find("`tooth_height` is 1 mm"), std::string::npos)
        << refusal({{"blade_height", 2.0_mm}});
    EXPECT_EQ(refusal({}), "");
}

TEST(StraightBlade, HasNoThicknessOfZeroWithinItsRange) {  // S-18
    for (const auto& info : test::plugins().catalog())
        if (info.id == "reciprocating_blade")
            for (const auto& p : info.parameters) {
                EXPECT_FALSE(p.source.empty()) << p.id;
                if (p.id == "blade_thickness" || p.id == "blade_height" || p.id == "stroke") {
                    EXPECT_GT(p.min, 0.0);
                }
            }
}

}  // namespace
}  // namespace kerf::sawing
