// SPDX-License-Identifier: Apache-2.0
// A still tip before bone that is thin: what breaks out, and under what.
#include "plugins/drilling/breaking_wall.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <utility>

#include "tests/support/drill_rig.h"

namespace kerf {
namespace {

using namespace literals;

constexpr double cortex = 1850.0;                               // [kg/m³]
constexpr double tension = 68e6 * 1.85 * 1.85 * 133.0 / 193.0;  // [Pa] that cracks it

/// What a plate bears that is met at `tilt`: 4π m along its normal, and what rubs across that, with μ = 0.3 [N].
double closed_form(double thickness, double tilt = 0.0) {
    return 4.0 * pi * tension * thickness * thickness / 6.0 * (std::cos(tilt) + 0.3 * std::sin(tilt));
}

/// An awl, 0.5 mm and 60° at its end and then 30° to 4 mm, above a plate that it meets at `tilt`.
struct Awl {
    double tilt;  ///< [rad]
    Body body;
    ToolSetup setup;
    Simulation simulation;
    int broke = 0;         ///< times
    double deepest = 0.0;  ///< [m] it was led to

    explicit Awl(double thickness, double spacing = 0.25_mm, double askew = 0.0,
                 const std::string& tool = "profile_drill", const std::map<std::string, double>& shape = slender())
        : Awl(made_of(thickness, spacing), tool, shape, askew) {}
    explicit Awl(Body made, const std::string& tool = "profile_drill",
                 const std::map<std::string, double>& shape = slender(), double askew = 0.0)
        : tilt(askew),
          body(std::move(made)),
          setup(test::drill(tool, shape)),
          simulation(body, setup, test::outline(setup), test::gains(0.005), test::at_depth(-0.2_mm, askew)),
          deepest(-0.2_mm) {}

    static std::map<std::string, double> slender() {
        return {{"spindle_speed", 0.0},
                {"diameter", 0.5_mm},
                {"point_angle", 60.0_deg},
                {"depth_1", 0.433_mm + 1.75_mm / std::tan(15.0_deg)},
                {"diameter_1", 4.0_mm}};
    }
    static Body made_of(double thickness, double spacing) {
        Body made = test::block({-8.0_mm, -8.0_mm, -thickness}, {8.0_mm, 8.0_mm, 0}, spacing, {0.31, 0.17, 0.73});
        made.materials = {{"bone", cortex, {}}};
        return made;
    }
    [[nodiscard]] double depth() const { return -simulation.world_from_tool().position.z; }
    TickResult tell(const TickResult& r) {
        for (std::size_t i = 0; i < r.event_count; ++i) broke += std::string(r.events[i]) == "drilling.wall_broken";
        return r;
    }
    double led_to(Vec3 entry, double to) {
        return tell(simulation.tick_direct({test::at_depth(to, tilt, entry)})).thrust;
    }
    /// The largest thrust on the way to a depth, by so much a tick [m].
    double peak(double to, Vec3 entry = {}, double step = 8.0_um) {
        double most = 0.0;
        for (; deepest < to; deepest += step) most = std::max(most, led_to(entry, deepest));
        return most;
    }
    void push(double force) {
        const CouplingGains g = test::gains(0.005);
        (void)tell(simulation.tick({test::at_depth(depth() + force * g.force_scale / g.stiffness)}));
    }
};

TEST(BreakingWall, APlateOfTwoVoxelsAndMoreBearsTheClosedForm) {
    struct Case {
        double thickness, tilt, spacing;
    };
    for (const Case& one :
         {Case{0.5_mm, 0.0, 0.25_mm}, Case{1.0_mm, 0.0, 0.5_mm}, Case{1.0_mm, 0.0, 0.25_mm}, Case{2.0_mm, 0.0, 0.25_mm},
          Case{0.5_mm, 25.0_deg, 0.125_mm}, Case{1.0_mm, 25.0_deg, 0.25_mm}, Case{2.0_mm, 25.0_deg, 0.5_mm},
          Case{0.5_mm, 50.0_deg, 0.25_mm}, Case{1.0_mm, 50.0_deg, 0.5_mm}, Case{1.0_mm, 50.0_deg, 0.125_mm}}) {
        Awl awl(one.thickness, one.spacing, one.tilt);
        EXPECT_NEAR(awl.peak(11.0_mm) / closed_form(one.thickness, one.tilt), 1.0, 0.04)
            << one.thickness << ", " << one.tilt / 1.0_deg << ", " << one.spacing;
        EXPECT_EQ(awl.broke, 1) << one.thickness << ", " << one.tilt / 1.0_deg << ", " << one.spacing;
    }
}

TEST(BreakingWall, WideTipsLookAsCloselyAsSlenderOnes) {
    for (const auto& [diameter, point] :
         {std::pair{6.0_mm, 118.0_deg}, std::pair{10.0_mm, 118.0_deg}, std::pair{14.0_mm, 60.0_deg}}) {
        Awl drill(0.5_mm, 0.25_mm, 0.0, "twist_drill",
                  {{"spindle_speed", 0.0}, {"diameter", diameter}, {"point_angle", point}});
        EXPECT_NEAR(drill.peak(1.0_mm, {}, 1.0_um) / closed_form(0.5_mm), 1.0, 0.06) << diameter;
        EXPECT_EQ(drill.broke, 1) << diameter;
    }
}

TEST(BreakingWall, APlateOfOneVoxelBearsLess) {
    Awl awl(0.5_mm, 0.5_mm);
    const double share = awl.peak(6.0_mm) / closed_form(0.5_mm);
    EXPECT_GT(share, 0.5);
    EXPECT_LT(share, 0.8) << "the limit that the model's text states";
    EXPECT_EQ(awl.broke, 1);
}

/// [m] of bone 16 mm wide, from the height `top` down to `bottom`.
double slab(Vec3 p, double top, double bottom) {
    return std::max({std::abs(p.x) - 8.0_mm, std::abs(p.y) - 8.0_mm, p.z - top, bottom - p.z});
}

Body cortex_with(const std::function<double(Vec3)>& surface) {
    Body made = Awl::made_of(1.0_mm, 0.25_mm);
    made.surface =
        LevelSet::build(Grid::covering({-9.0_mm, -9.0_mm, -20.0_mm}, {9.0_mm, 9.0_mm, 1.0_mm}, 0.25_mm), surface);
    return made;
}

/// A plate over a block, with free space of `gap` [m] between them; no block: 0.
Body plate_over(double thickness, double gap) {
    if (gap == 0.0) return Awl::made_of(thickness, 0.25_mm);
    return cortex_with([=](Vec3 p) { return std::min(slab(p, 0.0, -thickness), slab(p, -thickness - gap, -18.0_mm)); });
}

TEST(BreakingWall, OnceBrokenItBearsHardlyAnythingWhateverLiesBehind) {
    for (const double gap : {0.0_mm, 6.0_mm, 4.0_mm, 3.0_mm}) {
        Awl awl(plate_over(1.0_mm, gap));
        double broken = 0.0, after = 0.0;
        for (double depth = -0.2_mm; depth < (gap > 0.0 ? 0.9_mm + gap : 7.5_mm); depth += 8.0_um) {
            double& most = awl.broke == 0 ? broken : after;
            most = std::max(most, awl.led_to({}, depth));
        }
        EXPECT_NEAR(broken / closed_form(1.0_mm), 1.0, 0.05) << gap;
        EXPECT_LT(after, 0.08 * broken) << gap << ", in any tick";
        EXPECT_EQ(awl.broke, 1) << gap;
    }
}

TEST(BreakingWall, AnotherPlateBehindIsWhole) {
    // 6 mm behind it: the first one is still about the cone, broken
    Awl awl(cortex_with([](Vec3 p) { return std::min(slab(p, 0.0, -1.0_mm), slab(p, -7.0_mm, -8.0_mm)); }));
    (void)awl.peak(6.5_mm);
    ASSERT_EQ(awl.broke, 1);
    EXPECT_NEAR(awl.peak(14.0_mm) / closed_form(1.0_mm), 1.0, 0.05);
    EXPECT_EQ(awl.broke, 2);
}

TEST(BreakingWall, SetDownBesideItTheWallIsWhole) {
    Awl awl(1.0_mm);
    const double first = awl.peak(9.0_mm, {-3.0_mm, 0, 0});
    for (double depth = 9.0_mm; depth > -0.5_mm; depth -= 0.1_mm) (void)awl.led_to({-3.0_mm, 0, 0}, depth);
    for (double x = -3.0_mm; x < 3.0_mm; x += 0.1_mm)
        (void)awl.led_to({x, 0, 0}, -0.5_mm);  // half a millimetre above it
    awl.deepest = -0.5_mm;
    const double second = awl.peak(9.0_mm, {3.0_mm, 0, 0});
    EXPECT_NEAR(second / closed_form(1.0_mm), 1.0, 0.03);
    EXPECT_NEAR(second / first, 1.0, 0.01);
    EXPECT_EQ(awl.broke, 2);
}

// A pilot through a thin floor while the shoulder stands in thick bone: each bears its own.
TEST(BreakingWall, APilotBreaksItsFloorWhateverTheShoulderStandsIn) {
    const std::map<std::string, double> shape{{"spindle_speed", 0.0},
                                              {"diameter", 3.2_mm},
                                              {"shoulder_diameter", 5.0_mm},
                                              {"shoulder_angle", 118.0_deg},
                                              {"shoulder_depth", 7.0_mm}};
    Awl drill(cortex_with([](Vec3 p) {
                  const double bore = std::max(std::hypot(p.x, p.y) - 1.7_mm, -6.3_mm - p.z);  // a floor of 0.5 mm
                  return std::max(slab(p, 0.0, -6.8_mm), -bore);
              }),
              "step_drill", shape);
    double under = 0.0, depth = 4.0_mm;
    for (; depth < 9.0_mm && drill.broke == 0; depth += 8.0_um) under = drill.led_to({}, depth);
    EXPECT_NEAR(under / closed_form(0.5_mm), 1.0, 0.08);
    EXPECT_LT(depth, 6.8_mm) << "before its tip is through";
    double shoulder = 0.0;
    for (; depth < 8.0_mm; depth += 8.0_um) shoulder = std::max(shoulder, drill.led_to({}, depth));
    EXPECT_GT(shoulder, 1000.0) << "N: the shoulder crushes what is thick";
}

TEST(BreakingWall, PushedLessItStandsAndPushedMoreItGoesThrough) {
    Awl awl(1.0_mm);
    const double breaking_load = closed_form(1.0_mm);
    for (int i = 0; i < 3000; ++i) awl.push(std::min(0.001 * i, 0.8) * breaking_load);
    const double stands = awl.depth();
    for (int i = 0; i < 1000; ++i) awl.push(0.8 * breaking_load);
    EXPECT_NEAR(awl.depth(), stands, 5.0_um) << "in a second";
    EXPECT_EQ(awl.broke, 0);
    for (int i = 0; i < 4000 && awl.depth() < 8.0_mm; ++i) awl.push(1.1 * breaking_load);
    EXPECT_GE(awl.depth(), 8.0_mm);
    EXPECT_EQ(awl.broke, 1);
}

TEST(BreakingWall, AShoulderThatIsStillAboveBoneChangesNothing) {
    const auto breaks_at = [](double shoulder_depth) {
        Awl drill(4.0_mm, 0.25_mm, 0.0, "step_drill",
                  {{"spindle_speed", 0.0},
                   {"diameter", 2.0_mm},
                   {"shoulder_diameter", 4.0_mm},
                   {"shoulder_depth", shoulder_depth}});
        double depth = -0.2_mm;
        for (; depth < 6.0_mm && drill.broke == 0; depth += 8.0_um) (void)drill.led_to({}, depth);
        return depth;
    };
    const double alone = breaks_at(10.0_mm);
    EXPECT_LT(alone, 2.95_mm) << "before the shoulder at 3 mm is there";
    EXPECT_NEAR(breaks_at(3.0_mm), alone, 0.1_mm);
}

TEST(BreakingWall, ThickBoneIsCrushedUntilItIsThin) {
    // A blunt tip takes 2.2 kN to crush; 2.6 mm bear that.
    const std::map<std::string, double> blunt{{"spindle_speed", 0.0}, {"diameter", 3.2_mm}, {"runout", 0.0}};
    Awl drill(6.0_mm, 0.25_mm, 0.0, "twist_drill", blunt);
    const double crushes = 68e6 * 1.85 * 1.85 * pi * 1.6_mm * 1.6_mm * (1.0 + 0.3 / std::tan(59.0_deg));
    EXPECT_NEAR(drill.peak(2.5_mm) / crushes, 1.0, 0.03);
    EXPECT_EQ(drill.broke, 0);
    EXPECT_NEAR(drill.peak(4.5_mm) / crushes, 1.0, 0.03);
    EXPECT_EQ(drill.broke, 1) << "the last of it";
    EXPECT_LT(drill.led_to({}, 4.6_mm), 0.05 * crushes);
}

TEST(BreakingWall, ItIsTheSameSeenInAMirror) {
    Awl right(1.0_mm, 0.25_mm, 40.0_deg), left(1.0_mm, 0.25_mm, -40.0_deg);
    EXPECT_NEAR(left.peak(11.0_mm) / right.peak(11.0_mm), 1.0, 0.01);
}

TEST(BreakingWall, ItIsTheSameAtEveryRate) {
    const auto peak = [](double step) { return Awl(1.0_mm).peak(9.0_mm, {}, step); };
    EXPECT_NEAR(peak(2.0_um) / peak(20.0_um), 1.0, 0.02);
}

// ---- The shells on ways, told by hand -------------------------------------------------------------------------------

/// Single ways, asked about by a tip before a plate.
struct Ways {
    Awl awl;
    explicit Ways(double thickness, double tip) : awl(thickness) { (void)awl.led_to({}, tip); }
    [[nodiscard]] drilling::Shells ask(Vec3 from, Vec3 along) const {
        const drilling::Ray way{from, along, 0.0};
        return drilling::Shells({&way, 1}, 0.15_mm, 0.0, BoneQuery(awl.simulation.bone().query()));
    }
};

TEST(Shells, APlateIsAsThickAsItIsUprightOrAskew) {
    const Ways ways(2.0_mm, -1.0_mm);
    const drilling::Shells upright = ways.ask({0, 0, 0.5_mm}, {0, 0, 1});
    EXPECT_NEAR(upright.on(0).load / closed_form(2.0_mm), 1.0, 0.03);
    EXPECT_NEAR(upright.on(0).before, 0.5_mm, 0.03_mm) << "of air";
    EXPECT_NEAR(upright.on(0).normal.z, 1.0, 0.02) << "tool's z is into the bone";
    const drilling::Shells askew = ways.ask({-1.0_mm, 0, 0.5_mm}, {std::sin(40.0_deg), 0, std::cos(40.0_deg)});
    EXPECT_NEAR(askew.on(0).load / closed_form(2.0_mm), 1.0, 0.03) << "as thick, and no longer";
}

TEST(Shells, AWayThatMeetsNoBoneTellsNothingAndOneWithoutAFarSideNever) {
    const Ways ways(10.0_mm, -1.0_mm);
    EXPECT_EQ(ways.ask({0, 0, 0.5_mm}, {1, 0, 0}).on(0).load, 0.0) << "it stays above";
    EXPECT_EQ(ways.ask({0, 0, 1.2_mm}, {0, 0, 1}).on(0).load, drilling::Shell::never) << "32 steps end in bone";
    EXPECT_EQ(ways.ask({0, 0, 2.0_mm}, {0, 0, -1}).on(0).load, drilling::Shell::never)
        << "it comes out where the tip came in";
}

// ---- What has broken ------------------------------------------------------------------------------------------------

/// A wall across the shaft, whose far side is so far beyond the tip [m].
drilling::Shell wall_at(double beyond, double load) {
    return {.load = load, .normal = {0, 0, 1}, .far = {0, 0, beyond}};
}

TEST(BrokenWall, IsToldOnceAndOfNoSliver) {
    drilling::BrokenWall wall(1.0_mm);
    EXPECT_FALSE(wall.is_there());
    EXPECT_FALSE(wall.break_out(wall_at(0.0, 3.0))) << "a sliver";
    EXPECT_TRUE(wall.break_out(wall_at(0.0, 80.0)));
    EXPECT_FALSE(wall.break_out(wall_at(0.1_mm, 100.0))) << "more of the same";
    EXPECT_TRUE(wall.break_out(wall_at(4.0_mm, 50.0))) << "the next";
}

TEST(BrokenWall, IsItselfAloneAndWhatIsStrongerIsLeft) {
    drilling::BrokenWall wall(1.0_mm);
    EXPECT_EQ(wall.fraction_intact(wall_at(0.0, 10.0)), 1.0) << "nothing has broken";
    (void)wall.break_out(wall_at(0.0, 100.0));
    EXPECT_EQ(wall.fraction_intact(wall_at(0.5_mm, 100.0)), 0.0);
    EXPECT_EQ(wall.fraction_intact(wall_at(0.0, 125.0)), 0.0);
    EXPECT_DOUBLE_EQ(wall.fraction_intact(wall_at(0.0, 137.5)), 0.5);
    EXPECT_EQ(wall.fraction_intact(wall_at(0.0, 150.0)), 1.0);
    EXPECT_EQ(wall.fraction_intact(wall_at(3.0_mm, 50.0)), 1.0) << "behind it";
    EXPECT_EQ(wall.fraction_intact({.load = 50.0, .normal = {0.8, 0, -0.6}}), 1.0) << "on another side";
}

TEST(BrokenWall, StaysWhereItIsAndIsForgottenTwoRadiiAway) {
    drilling::BrokenWall wall(1.0_mm);  // radius 2 mm
    (void)wall.break_out(wall_at(0.0, 100.0));
    for (int i = 0; i < 1000; ++i) wall.move_with_tip({0, 0, (i % 2 ? 100.0 : -100.0) * 1.0_mm, 0, 0, 0}, 1e-3, false);
    EXPECT_TRUE(wall.is_there()) << "a hand trembles";
    for (int i = 0; i < 30; ++i) wall.move_with_tip({0, 0, 100.0_mm, 0, 0, 0}, 1e-3, true);
    EXPECT_EQ(wall.fraction_intact(wall_at(-3.0_mm, 100.0)), 0.0) << "3 mm farther, seen from the tip it is 3 mm back";
    for (int i = 0; i < 39; ++i) wall.move_with_tip({100.0_mm, 0, 0, 0, 0, 0}, 1e-3, false);
    EXPECT_TRUE(wall.is_there());
    for (int i = 0; i < 2; ++i) wall.move_with_tip({100.0_mm, 0, 0, 0, 0, 0}, 1e-3, false);
    EXPECT_FALSE(wall.is_there());
}

TEST(BrokenWall, IsRememberedAnewWhileTheTipPressesOnIt) {
    drilling::BrokenWall wall(1.0_mm);  // forgotten 4 mm away
    (void)wall.break_out(wall_at(0.0, 100.0));
    const auto lift = [&] {
        for (int i = 0; i < 30; ++i) wall.move_with_tip({0, 0, -(100.0_mm), 0, 0, 0}, 1e-3, false);
    };
    lift();
    wall.move_with_tip({}, 1e-3, true);
    lift();
    EXPECT_TRUE(wall.is_there()) << "3 mm since it was pressed on";
    lift();
    EXPECT_FALSE(wall.is_there()) << "6 mm";
}

TEST(BrokenWall, TurnsWithTheBoneSeenFromTheTip) {
    drilling::BrokenWall wall(1.0_mm);
    (void)wall.break_out(wall_at(0.0, 100.0));
    for (int i = 0; i < 1571; ++i)
        wall.move_with_tip({0, 0, 0, 0, 1.0, 0}, 1e-3, true);  // the tip turns by 90 degrees about y
    EXPECT_EQ(wall.fraction_intact({.load = 100.0, .normal = {-1, 0, 0}}), 0.0);
    EXPECT_EQ(wall.fraction_intact(wall_at(0.0, 100.0)), 1.0);
}

}  // namespace
}  // namespace kerf
