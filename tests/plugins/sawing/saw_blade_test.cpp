// SPDX-License-Identifier: Apache-2.0
#include "plugins/sawing/saw_blade.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <map>
#include <string>

#include "plugins/sawing/saw_force.h"
#include "tests/support/saw_rig.h"

namespace kerf::sawing {
namespace {

using namespace literals;

SawBlade blade(const std::map<std::string, double>& set = {}) {
    return value_of<sawing::OscillatingBlade>(test::saw(set).tool_parameters).blade();
}

// C.7: 5° at 60 mm.
TEST(SawBlade, ItsStrokeIsTheArcOfItsSwing) { EXPECT_NEAR(blade().stroke(), 5.236_mm, 0.001_mm); }

TEST(SawBlade, KerfIsTheBladeAndItsSetOnBothSides) {
    EXPECT_NEAR(blade({{"blade_thickness", 0.9_mm}, {"tooth_set", 0.05_mm}}).kerf(), 1.0_mm, 1e-15);
}

// E03-2: the angle of the tooth at the middle is none, and tips lie on the arc, a pitch apart along it.
TEST(SawBlade, TeethLieOnTheArcAPitchApartAndFaceOutwards) {
    const SawBlade b = blade({{"tooth_count", 17.0}});
    for (const double swing : {0.0_deg, 2.0_deg, -2.5_deg}) {
        const Teeth teeth = teeth_of(b, swing);
        ASSERT_EQ(teeth.count, 17u);
        for (std::size_t i = 0; i < teeth.count; ++i) {
            const Tooth& t = teeth.tooth[i];
            const Vec3 from_axis = t.tip - Vec3{0, t.tip.y, -b.radius};
            EXPECT_NEAR(length(from_axis), b.radius, 1e-12);
            EXPECT_NEAR(dot(t.normal, from_axis), b.radius, 1e-12);
            EXPECT_NEAR(dot(t.normal, t.along), 0.0, 1e-12);
            EXPECT_NEAR(length(t.along), 1.0, 1e-12);
            const double angle = (static_cast<double>(i) - 8.0) * b.pitch / b.radius + swing;
            EXPECT_NEAR(t.tip.x, b.radius * std::sin(angle), 1e-12);
        }
    }
}

TEST(SawBlade, AGrowingSwingMovesTeethTheWayTheySay) {
    const SawBlade b = blade();
    const Teeth before = teeth_of(b, 0.0), after = teeth_of(b, 1e-6);
    for (std::size_t i = 0; i < before.count; ++i) {
        const Vec3 moved = after.tooth[i].tip - before.tooth[i].tip;
        EXPECT_NEAR(length(moved - 1e-6 * b.radius * before.tooth[i].along), 0.0, 1e-13);
    }
}

// E03-5
TEST(SawBlade, TeethAreSetToOneSideAndTheOtherByTurns) {
    const Teeth teeth = teeth_of(blade(), 0.0);
    double sum = 0.0;
    for (std::size_t i = 0; i < teeth.count; ++i) {
        sum += teeth.tooth[i].side;
        EXPECT_EQ(teeth.tooth[i].side, i % 2 == 0 ? 1.0 : -1.0);
        EXPECT_GT(teeth.tooth[i].side * teeth.tooth[i].tip.y, 0.0);
    }
    EXPECT_EQ(sum, 0.0);
}

TEST(SawBlade, SweepsWhatItsTeethReachAtEitherTurningPoint) {
    const ToolSetup setup = test::saw();
    const SawBlade b = blade();
    const ToolOutline outline = test::outline(setup);
    EXPECT_TRUE(outline.cutting.is_prism());
    EXPECT_NEAR(outline.cutting.thickness(), 1.0_mm, 1e-15);
    EXPECT_NEAR(outline.whole.thickness(), 0.8_mm, 1e-15);
    for (const double swing : {-0.5 * b.arc, 0.0, 0.5 * b.arc}) {
        const Teeth teeth = teeth_of(b, swing);
        for (std::size_t i = 0; i < teeth.count; ++i)
            EXPECT_NEAR(outline.cutting.distance({teeth.tooth[i].tip.x, 0.0, teeth.tooth[i].tip.z}), 0.0, 8.0_um)
                << "on the front of what it removes";
    }
    EXPECT_NEAR(outline.cutting.largest_radius(), b.radius * std::sin(b.half_front() + 0.5 * b.arc), 1e-12);
}

// ---- what is no blade -----------------------------------------------------------------------------------------------

TEST(SawBlade, RefusesTeethThatAreNoWholeNumberAndAFrontThatGoesAround) {
    ToolOutline outline;
    std::string why;
    EXPECT_FALSE(outline_of(test::saw({{"tooth_count", 2.5}}), outline, why));
    EXPECT_NE(why.find("oscillating_blade"), std::string::npos);
    EXPECT_FALSE(outline_of(test::saw({{"tooth_count", 64.0}, {"tooth_pitch", 5.0_mm}}), outline, why))
        << "320 mm of teeth on an arc of 60 mm";
    EXPECT_FALSE(
        outline_of(test::saw({{"radius", 20.0_mm}, {"tooth_count", 14.0}, {"tooth_height", 16.0_mm}}), outline, why))
        << "teeth as long as the blade";
    EXPECT_TRUE(outline_of(test::saw(), outline, why)) << why;
}

TEST(SawBlade, HasNoTeethlessBladeWithinItsRanges) {
    for (const auto& info : test::plugins().catalog())
        if (info.id == "oscillating_blade")
            for (const auto& p : info.parameters) {
                EXPECT_LE(p.min, p.def) << p.id;
                EXPECT_LE(p.def, p.max) << p.id;
                EXPECT_FALSE(p.source.empty()) << p.id;
                if (p.id == "tooth_count") {
                    EXPECT_EQ(p.min, 1.0) << "none is out of range, and refused where the procedure is read";
                }
                if (p.id == "blade_thickness") {
                    EXPECT_GT(p.min, 0.0);
                }
            }
}

}  // namespace
}  // namespace kerf::sawing
