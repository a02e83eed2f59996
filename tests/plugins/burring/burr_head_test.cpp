// SPDX-License-Identifier: Apache-2.0
// The geometry of a burr's head, and what of its parameters does not go together.
#include "plugins/burring/burr_head.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "tests/support/burr_rig.h"

namespace kerf {
namespace {

using namespace literals;
using burring::BurrHead;
using burring::CylindricalBurr;
using burring::MeridianPoint;
using burring::PearBurr;
using burring::RoundBurr;

/// What the host says of a tool with these parameters; empty: it takes it.
std::string refused(const std::string& tool, const std::map<std::string, double>& set) {
    ToolOutline outline;
    std::string error;
    return outline_of(test::burr_of(tool, set), outline, error) ? "" : error;
}

TEST(RoundBurrHead, IsABallUpToItsNeck) {
    const BurrHead head = defaults_of<RoundBurr>().head();
    EXPECT_NEAR(head.widest_radius(), 2.0_mm, 1e-12);
    EXPECT_NEAR(head.at(head.meridian()).radius, 0.8_mm, 1e-12) << "as wide as the neck";
    for (int i = 0; i <= 20; ++i) {
        const MeridianPoint p = head.at(head.meridian() * i / 20.0);
        EXPECT_NEAR(std::hypot(p.radius, p.z + 2.0_mm), 2.0_mm, 1e-12);
        EXPECT_NEAR(p.normal_r * 2.0_mm, p.radius, 1e-12) << "away from the centre";
        EXPECT_NEAR(p.normal_z * 2.0_mm, p.z + 2.0_mm, 1e-12);
    }
    // 180° − asin(0.8/2) = 156.42° of an arc of 2 mm
    EXPECT_NEAR(head.meridian(), 5.460_mm, 0.001_mm);
}

TEST(CylindricalBurrHead, HasAnEndACornerAndASide) {
    const BurrHead head = defaults_of<CylindricalBurr>().head();
    EXPECT_NEAR(head.meridian(), 1.7_mm + 0.3_mm * 0.5 * pi + 7.7_mm, 1e-12);
    const MeridianPoint end = head.at(1.0_mm), side = head.at(head.meridian() - 1.0_mm);
    EXPECT_EQ(end.z, 0.0);
    EXPECT_EQ(end.normal_z, 1.0);
    EXPECT_NEAR(side.radius, 2.0_mm, 1e-12);
    EXPECT_NEAR(side.z, -7.0_mm, 1e-12);
    EXPECT_NEAR(side.normal_r, 1.0, 1e-12);
    EXPECT_NEAR(head.end_z(), -8.0_mm, 1e-12);
}

TEST(PearBurrHead, NarrowsBehindItsEquator) {
    const PearBurr pear = defaults_of<PearBurr>();
    const BurrHead head = pear.head();
    EXPECT_NEAR(head.widest_radius(), 2.0_mm, 1e-12);
    EXPECT_NEAR(head.end_z(), -6.0_mm, 1e-9);
    const MeridianPoint end = head.at(head.meridian()), before = head.at(head.meridian() - 1.0_mm);
    EXPECT_NEAR((before.radius - end.radius) / (before.z - end.z), std::tan(pear.taper), 1e-9);
    EXPECT_GT(end.radius, head.neck_radius);
}

// The meridian has no jump in place or normal, so the sectors and the outline have none either.
TEST(BurrHead, IsSmoothAllAlong) {
    for (const BurrHead& head :
         {defaults_of<RoundBurr>().head(), defaults_of<PearBurr>().head(), defaults_of<CylindricalBurr>().head()}) {
        constexpr int steps = 2000;
        for (int i = 1; i <= steps; ++i) {
            const double step = head.meridian() / steps;
            const MeridianPoint a = head.at(step * (i - 1)), b = head.at(step * i);
            EXPECT_LE(std::hypot(b.radius - a.radius, b.z - a.z), step * (1.0 + 1e-9)) << i;
            EXPECT_LE(std::hypot(b.normal_r - a.normal_r, b.normal_z - a.normal_z), step / head.arc_radius * 1.001);
            EXPECT_NEAR(std::hypot(b.normal_r, b.normal_z), 1.0, 1e-12);
        }
    }
}

TEST(BurrTool, IsRefusedWithItsReason) {
    EXPECT_EQ(refused("round_burr", {}), "");
    EXPECT_NE(refused("round_burr", {{"blades", 6.5}}).find("`blades` is 6.5; it needs a whole number."),
              std::string::npos);
    const std::string neck = refused("round_burr", {{"diameter", 1.0_mm}});
    EXPECT_NE(neck.find("`neck_diameter` is 1.6 mm"), std::string::npos) << neck;
    EXPECT_NE(neck.find("0.95 mm or less"), std::string::npos) << neck;
    const std::string corner = refused("cylindrical_burr", {{"corner_radius", 3.0_mm}});
    EXPECT_NE(corner.find("half of `diameter` or less, 2 mm"), std::string::npos) << corner;
    EXPECT_NE(refused("cylindrical_burr", {{"head_length", 40.0_mm}, {"length", 20.0_mm}}).find("`length` is 20 mm"),
              std::string::npos);
    EXPECT_NE(refused("pear_burr", {{"head_length", 2.0_mm}}).find("`head_length` is 2 mm"), std::string::npos);
    EXPECT_NE(refused("pear_burr", {{"taper", 45.0_deg}, {"neck_diameter", 3.0_mm}}).find("`neck_diameter` is 3 mm"),
              std::string::npos);
}

}  // namespace
}  // namespace kerf
