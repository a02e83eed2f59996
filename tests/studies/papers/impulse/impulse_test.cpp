// SPDX-License-Identifier: Apache-2.0
// Impulses of a rigid tool that strikes at many points (validation A.5: E04-1 … E04-6, A.6: P2, D.4: S-10, S-17, S-18).
#include "studies/papers/impulse/impulse.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "studies/papers/impulse/reciprocating_impulse.h"
#include "tests/studies/papers/as_printed/printed_rig.h"
#include "tests/support/loop_guard.h"
#include "tests/support/rig.h"
#include "tests/support/saw_rig.h"

namespace kerf::papers {
namespace {

using namespace literals;
using sawing::Stroke;

/// Eigenvalues of a symmetric matrix, in rising order, by the trigonometric solution.
std::array<double, 3> eigenvalues(const Symmetric3& m) {
    const double off = m.xy * m.xy + m.xz * m.xz + m.yz * m.yz, mean = (m.xx + m.yy + m.zz) / 3.0;
    const double spread = std::sqrt(
        ((m.xx - mean) * (m.xx - mean) + (m.yy - mean) * (m.yy - mean) + (m.zz - mean) * (m.zz - mean) + 2.0 * off) /
        6.0);
    if (spread == 0.0) return {mean, mean, mean};
    const double a = (m.xx - mean) / spread, b = (m.yy - mean) / spread, c = (m.zz - mean) / spread, d = m.xy / spread,
                 e = m.xz / spread, f = m.yz / spread;
    const double half_determinant = 0.5 * (a * (b * c - f * f) - d * (d * c - f * e) + e * (d * f - b * e));
    const double angle = std::acos(std::clamp(half_determinant, -1.0, 1.0)) / 3.0;
    const double largest = mean + 2.0 * spread * std::cos(angle),
                 least = mean + 2.0 * spread * std::cos(angle + 2.0 * pi / 3.0);
    return {least, 3.0 * mean - largest - least, largest};
}

/// Random vectors and inertias.
struct Dice {
    std::mt19937_64 source{2026};
    double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(source); }
    Vec3 vector(double size) { return {in(-size, size), in(-size, size), in(-size, size)}; }
    Quat rotation() { return quat_from_rotation_vector(vector(3.0)); }
    /// The inverse inertia of a uniform box of `mass`, turned at random.
    Symmetric3 inverse_inertia(double mass) {
        const double a = in(1e-3, 0.3), b = in(1e-3, 0.3), c = in(1e-4, 0.3);
        const Vec3 inverse{12.0 / mass / (b * b + c * c), 12.0 / mass / (a * a + c * c), 12.0 / mass / (a * a + b * b)};
        const Quat turn = rotation();
        const Vec3 x = rotate(turn, {1, 0, 0}), y = rotate(turn, {0, 1, 0}), z = rotate(turn, {0, 0, 1});
        const auto part = [&](double Vec3::*i, double Vec3::*j) {
            return inverse.x * x.*i * x.*j + inverse.y * y.*i * y.*j + inverse.z * z.*i * z.*j;
        };
        return {part(&Vec3::x, &Vec3::x), part(&Vec3::y, &Vec3::y), part(&Vec3::z, &Vec3::z),
                part(&Vec3::x, &Vec3::y), part(&Vec3::x, &Vec3::z), part(&Vec3::y, &Vec3::z)};
    }
};

double energy(const RigidTool& tool, const RigidMotion& motion) {
    const Symmetric3 inertia = inverse_of(tool.inverse_inertia);
    return 0.5 * (tool.mass * dot(motion.velocity, motion.velocity) + dot(motion.turn, inertia * motion.turn));
}
Strike strike_at(Vec3 r, Vec3 normal) {
    Strike one;
    one.r = r;
    one.normal = normal;
    return one;
}
Vec3 sum_of(std::span<const Strike> strikes) {
    Vec3 sum{0, 0, 0};
    for (const Strike& one : strikes) sum = sum + one.impulse;
    return sum;
}

// ---- K --------------------------------------------------------------------------------------------------------------

TEST(CollisionMatrix, IsSymmetricAndNeverBelowOneOverTheMass) {  // P2, E04-1
    Dice dice;
    for (int i = 0; i < 100000; ++i) {
        const double mass = dice.in(0.01, 5.0);
        const RigidTool tool{mass, dice.inverse_inertia(mass)};
        const Vec3 r = dice.vector(0.3), p = dice.vector(1.0), q = dice.vector(1.0);
        const Symmetric3 k = collision_matrix(tool, r);
        const Vec3 by_definition = p / mass + cross(tool.inverse_inertia * cross(r, p), r), kp = k * p;
        ASSERT_NEAR(length(kp - by_definition), 0.0, 1e-12 * length(by_definition)) << i;
        ASSERT_NEAR(dot(q, kp), dot(p, k * q), 1e-12 * length(q) * length(kp)) << i;
        const auto eigen = eigenvalues(k);
        ASSERT_GE(eigen[0], 1.0 / mass - 1e-9 * eigen[2]) << i;
    }
}

TEST(CollisionMatrix, HasTheEigenvaluesOfARodAndAPlate) {
    constexpr double mass = 0.3, length_ = 0.2, about = mass * length_ * length_ / 12.0;
    const auto rod = eigenvalues(collision_matrix({mass, {0.0, 1.0 / about, 1.0 / about}}, {0.5 * length_, 0, 0}));
    EXPECT_NEAR(mass * rod[0], 1.0, 1e-12) << "along the rod";
    EXPECT_NEAR(mass * rod[1], 4.0, 1e-12) << "across it at its end";
    EXPECT_NEAR(mass * rod[2], 4.0, 1e-12);
    const auto plate = eigenvalues(
        collision_matrix({mass, {1.0 / about, 1.0 / about, 0.5 / about}}, {0.5 * length_, 0.5 * length_, 0}));
    EXPECT_NEAR(mass * plate[0], 1.0, 1e-6);
    EXPECT_NEAR(mass * plate[1], 4.0, 1e-6) << "a square plate at its corner";
    EXPECT_NEAR(mass * plate[2], 7.0, 1e-6);
}

TEST(CollisionMatrix, KeepsItsLeastEigenvalueHoweverThinTheTool) {  // S-18, E04-8
    constexpr double mass = 0.1, a = 0.05, b = 0.01;
    for (double thickness = 2e-3; thickness > 9e-6; thickness *= 0.5) {
        const Symmetric3 inverse_inertia{12.0 / mass / (b * b + thickness * thickness),
                                         12.0 / mass / (a * a + thickness * thickness), 12.0 / mass / (a * a + b * b)};
        for (double arm = 0.0; arm <= 0.3; arm += 0.05) {
            const auto eigen = eigenvalues(collision_matrix({mass, inverse_inertia}, {arm, 0, 0}));
            EXPECT_NEAR(eigen[0] * mass, 1.0, 1e-6);
            EXPECT_LE(eigen[2] * mass, 1.0 + 12.0 * arm * arm / (a * a) + 1e-6);
        }
    }
}

TEST(CollisionMatrix, IsUndoneByItsInverse) {
    Dice dice;
    for (int i = 0; i < 1000; ++i) {
        const Symmetric3 k = collision_matrix({0.5, dice.inverse_inertia(0.5)}, dice.vector(0.1));
        const Vec3 p = dice.vector(1.0);
        EXPECT_NEAR(length(inverse_of(k) * (k * p) - p), 0.0, 1e-9);
    }
}

// ---- one strike -----------------------------------------------------------------------------------------------------

TEST(Strike, SticksWithTheClosedForm) {  // E04-2
    Dice dice;
    const Restitution law{0.6, 10.0};  // so much friction that it sticks
    int stuck = 0;
    for (int i = 0; i < 1000; ++i) {
        const RigidTool tool{0.5, dice.inverse_inertia(0.5)};
        Strike one = strike_at(dice.vector(0.02), {0, 0, 1});
        const RigidMotion before{{dice.in(-0.2, 0.2), dice.in(-0.2, 0.2), -1.0}, dice.vector(1.0)};
        const Vec3 u = before.at(one.r);
        if (u.z >= 0.0) continue;
        const Struck struck = solve_strikes(tool, before, law, {&one, 1});
        if (struck.fraction < 1.0) continue;  // more energy than before: tested below
        const Vec3 expected = inverse_of(collision_matrix(tool, one.r)) * (Vec3{0, 0, -0.6 * u.z} - u);
        if (std::hypot(expected.x, expected.y) > 10.0 * expected.z) continue;
        ++stuck;
        ASSERT_NEAR(length(one.impulse - expected), 0.0, 1e-9 * length(expected)) << i;
        const Vec3 after = struck.motion.at(one.r);
        ASSERT_NEAR(length(after - Vec3{0, 0, -0.6 * u.z}), 0.0, 1e-9) << "only the normal part is reversed";
    }
    EXPECT_GT(stuck, 500);
}

TEST(Strike, SlidesWithTheClosedForm) {  // E04-3, E04-4
    const RigidTool tool{0.5, {900.0, 700.0, 800.0}};
    const Restitution law{0.6, 0.3};
    Strike one = strike_at({0.01, 0.02, -0.03}, {0, 0, 1});
    const RigidMotion before{{3.0, 1.0, -0.5}, {0, 0, 0}};
    const Struck struck = solve_strikes(tool, before, law, {&one, 1});
    const Vec3 u = before.at(one.r), t = normalized(Vec3{u.x, u.y, 0.0}), direction = Vec3{0, 0, 1} - 0.3 * t;
    const Symmetric3 k = collision_matrix(tool, one.r);
    const double j = -(1.0 + 0.6) * u.z / dot({0, 0, 1}, k * direction);
    EXPECT_NEAR(length(one.impulse - j * direction), 0.0, 1e-12);
    EXPECT_EQ(struck.fraction, 1.0);
    EXPECT_NEAR(struck.motion.at(one.r).z, -0.6 * u.z, 1e-12);
}

TEST(Strike, SticksUpToTheConeExactly) {  // 04-04: K ∝ I: |u_t| = μ (1 + e) |u_n|
    const RigidTool tool{0.5, {}};
    const Restitution law{0.6, 0.3};
    const double boundary = 0.3 * 1.6 * 1.0;
    const auto after = [&](double sideways) {
        Strike one = strike_at({0, 0, 0}, {0, 0, 1});
        return std::pair{solve_strikes(tool, {{sideways, 0, -1.0}, {}}, law, {&one, 1}).motion.velocity, one.impulse};
    };
    const auto [below, stuck] = after(boundary * (1.0 - 1e-9));
    const auto [above, slid] = after(boundary * (1.0 + 1e-9));
    EXPECT_NEAR(below.x, 0.0, 1e-15) << "it sticks";
    EXPECT_GT(above.x, 1e-10) << "it slides";
    EXPECT_NEAR(length(stuck - slid), 0.0, 1e-8) << "and there is no jump";
    EXPECT_NEAR(slid.z, 0.5 * 1.6, 1e-12);
    EXPECT_NEAR(slid.x, -0.3 * slid.z, 1e-12);
}

TEST(Strike, LeavesAPointThatLeavesTheBoneAlone) {
    Strike one = strike_at({0.01, 0, 0}, {0, 0, 1});
    const Struck struck = solve_strikes({0.5, {800, 800, 800}}, {{0.3, 0, 0.2}, {}}, {0.6, 0.3}, {&one, 1});
    EXPECT_EQ(length(one.impulse), 0.0);
    EXPECT_EQ(struck.energy, 0.0);
}

// ---- many strikes ---------------------------------------------------------------------------------------------------

TEST(Strikes, OfAPlaneActAsOneHoweverMany) {  // S-17, E04-5
    const RigidTool tool{1.0, {400.0, 400.0, 400.0}};
    const RigidMotion before{{1.5, 0.0, 1e-3}, {0, 0, 0}};
    for (const std::size_t count : {1u, 2u, 10u, 86u, 110u, 1000u}) {
        std::vector<Strike> strikes;
        for (std::size_t i = 0; i < count; ++i) {
            const double x =
                count == 1 ? 0.0 : 50.0_mm * (static_cast<double>(i) / static_cast<double>(count - 1) - 0.5);
            strikes.push_back(strike_at({x, 0.0, 5.0_mm}, {0, 0, -1}));
        }
        const Struck struck = solve_strikes(tool, before, {0.6, 0.3}, strikes);
        EXPECT_NEAR(-sum_of(strikes).z, 1.6e-3, 0.01 * 1.6e-3) << count << ": (1 + e) M u";
        EXPECT_LE(energy(tool, struck.motion), energy(tool, before)) << count;
        EXPECT_NEAR(energy(tool, struck.motion) - energy(tool, before), struck.energy, 1e-12) << count;
    }
}

TEST(Strikes, NeverMakeEnergyAndNeverPull) {
    Dice dice;
    int reduced = 0;
    for (int i = 0; i < 5000; ++i) {
        const RigidTool tool{0.5, dice.inverse_inertia(0.5)};
        const Restitution law{dice.in(0.0, 1.0), dice.in(0.0, 1.0)};
        std::vector<Strike> strikes;
        const int count = 1 + i % 40;
        for (int n = 0; n < count; ++n) strikes.push_back(strike_at(dice.vector(0.05), normalized(dice.vector(1.0))));
        const RigidMotion before{dice.vector(1.0), dice.vector(10.0)};
        const Struck struck = solve_strikes(tool, before, law, strikes);
        const double was = energy(tool, before);
        ASSERT_LE(energy(tool, struck.motion), was * (1.0 + 1e-9)) << i;
        ASSERT_LE(struck.energy, 1e-12 * was) << i;
        for (const Strike& one : strikes) {
            const double pressed = dot(one.impulse, one.normal);
            ASSERT_GE(pressed, -1e-15) << i;
            ASSERT_LE(length(one.impulse - pressed * one.normal), law.friction * pressed * (1.0 + 1e-9) + 1e-15) << i;
        }
        reduced += struck.fraction < 1.0;
    }
    EXPECT_GT(reduced, 0) << "Newton's restitution alone would have made energy";
    EXPECT_LT(reduced, 4000);
}

TEST(Strikes, SetEveryPointToItsRebound) {
    // Given three points that hold a plane, struck askew without friction
    const RigidTool tool{1.0, {400.0, 500.0, 600.0}};
    std::vector<Strike> strikes;
    for (const Vec3 r : {Vec3{0.02, 0, 0}, Vec3{-0.02, 0.02, 0}, Vec3{-0.02, -0.02, 0}})
        strikes.push_back(strike_at(r, {0, 0, 1}));
    const RigidMotion before{{0, 0, -1.0}, {0.5, -1.0, 0}};
    const Struck struck = solve_strikes(tool, before, {0.5, 0.0}, strikes);
    for (const Strike& one : strikes) EXPECT_NEAR(struck.motion.at(one.r).z, -0.5 * before.at(one.r).z, 1e-3);
}

TEST(Strikes, SoftPointsTakeOverWithoutAJump) {
    const RigidTool tool{1.0, {400.0, 400.0, 400.0}};
    const auto second = [&](double engaged) {
        std::array<Strike, 2> strikes{strike_at({-0.02, 0, 0}, {0, 0, 1}), strike_at({0.02, 0, 0}, {0, 0, 1})};
        strikes[1].softness = 1.0 / engaged - 1.0;
        (void)solve_strikes(tool, {{0, 0, -1.0}, {}}, {0.6, 0.3}, strikes);
        return strikes[1].impulse.z;
    };
    EXPECT_LT(second(1e-4), 1e-3);
    EXPECT_LT(second(0.2), second(0.5));
    EXPECT_NEAR(second(1.0), 0.8, 1e-3) << "half of (1 + e) M u";
}

TEST(Strikes, NeitherAllocateNorLockNorThrow) {
    std::array<Strike, 64> strikes;
    for (std::size_t i = 0; i < strikes.size(); ++i)
        strikes[i] = strike_at({1e-3 * static_cast<double>(i), 0, 5e-3}, {0, 0, -1});
    const test::Forbidden before = test::forbidden_here();
    (void)solve_strikes({1.0, {400.0, 400.0, 400.0}}, {{1.5, 0.0, 1e-3}, {}}, {0.6, 0.3}, strikes);
    EXPECT_EQ(test::forbidden_here(), before);
}

// ---- the law --------------------------------------------------------------------------------------------------------

// 250/s: twice 4 mm over 2 mm is 4 strikes an oscillation.
TEST(StrikeRate, IsTwoStrokesTimesTheTeethOfAStroke) {
    EXPECT_NEAR(strikes_per_second({4.0_mm, 2.0_mm, 250.0}), 1000.0, 1e-9);
    EXPECT_NEAR(strikes_per_second({1.0_mm, 2.0_mm, 250.0}), 500.0, 1e-9) << "at least once in each stroke";
    const Stroke stroke{4.0_mm, 2.0_mm, 250.0};
    EXPECT_NEAR(strikes_per_second(stroke) * chip_per_feed(stroke, 2.0 / pi), 1.0, 1e-12) << "as a chip grows";
}

ToolSetup impulse_saw(std::map<std::string, double> set = {}) {
    set.insert({{"blade_length", 20.0_mm}, {"tooth_pitch", 2.0_mm}, {"stroke", 4.0_mm}, {"run_up", 0.0}});
    return chart::NamedSetup{"papers.sawing", "reciprocating_blade", "reciprocating_impulse", set}.in(
        test::printed_plugins());
}
struct Feeding {
    test::Rig simulation;
    double dt, depth = -1.0_mm;
    explicit Feeding(const ToolSetup& setup, double period = Simulation::dt, double spacing = 0.5_mm)
        : simulation(test::block({-16.0_mm, -4.0_mm, -12.0_mm}, {16.0_mm, 4.0_mm, 0}, spacing, {0.31, 0.17, 0.73}),
                     setup, test::at_depth(-1.0_mm), test::gains(), period),
          dt(period) {}
    double go(double feed) {
        depth += feed * dt;
        const TickResult r = simulation.tick_direct({test::at_depth(depth)});
        EXPECT_FALSE(r.is_quarantined);
        return r.thrust;
    }
    double settled(double feed) {
        while (depth < 3.0_mm - 1e-12) (void)go(std::min<double>(8.0_mm_per_s, (3.0_mm - depth) / dt));
        double thrust = 0.0;
        for (int i = 0; i < 50; ++i) thrust = go(feed);
        return thrust;
    }
    [[nodiscard]] ReciprocatingImpulse::Signals signals() const {
        return signals_of<ReciprocatingImpulse>(simulation.signals());
    }
};

// (1 + e) M v ν = 1.6 · 1 kg · 1 mm/s · 1000/s
TEST(ImpulseSaw, MeetsTheHandCheckedNumber) {
    Feeding saw(impulse_saw());
    EXPECT_NEAR(saw.settled(1.0_mm_per_s), 1.6, 0.005);
    EXPECT_NEAR(saw.signals().vibration, 0.3 * 1.6, 0.005) << "the teeth slide: friction times thrust";
    EXPECT_NEAR(saw.signals().strike_rate, 1000.0, 1e-9);
    EXPECT_NEAR(saw.signals().engaged_teeth, 10.0, 1e-9);
}

TEST(ImpulseSaw, IsTheSameInTicksOfAnyLength) {  // S-10, E04-6: the printed form is eight times as large
    const double first = Feeding(impulse_saw(), 2e-3).settled(1.0_mm_per_s);
    for (const double dt : {1e-3, 0.5e-3, 0.25e-3})
        EXPECT_NEAR(Feeding(impulse_saw(), dt).settled(1.0_mm_per_s) / first, 1.0, 0.01) << dt;
}

TEST(ImpulseSaw, DoesNotGrowWithTheNumberOfTeeth) {  // P6, E04-5
    const double ten = Feeding(impulse_saw()).settled(1.0_mm_per_s);
    // Twice the teeth at the same strikes per second of each: pitch and stroke halved
    const double twenty = Feeding(impulse_saw({{"tooth_pitch", 1.0_mm}, {"stroke", 2.0_mm}})).settled(1.0_mm_per_s);
    EXPECT_NEAR(twenty / ten, 1.0, 0.05);
}

TEST(ImpulseSaw, RisesWithFeedAndRate) {  // E04-7: not the fall that is measured
    const double once = Feeding(impulse_saw()).settled(1.0_mm_per_s);
    EXPECT_NEAR(Feeding(impulse_saw()).settled(2.0_mm_per_s) / once, 2.0, 0.01);
    const double slow = Feeding(impulse_saw({{"stroke_rate", 8000.0_rpm}})).settled(1.0_mm_per_s);
    EXPECT_NEAR(once / slow, 15.0 / 8.0, 0.01);
}

TEST(ImpulseSaw, DoesNotKnowTheDensity) {  // 04-19
    Body light = test::block({-16.0_mm, -4.0_mm, -12.0_mm}, {16.0_mm, 4.0_mm, 0}, 0.5_mm, {0.31, 0.17, 0.73});
    light.materials[0].density = 350.0;
    test::Rig simulation(std::move(light), impulse_saw(), test::at_depth(-1.0_mm));
    (void)simulation.feed(-1.0_mm, 3.0_mm, 8.0_um);
    EXPECT_NEAR(simulation.feed(3.0_mm, 3.05_mm, 1.0_um).thrust, 1.6, 0.01) << "as in cortical bone";
}

TEST(ImpulseSaw, WithoutFeedThereIsNoForce) {  // P9
    Feeding saw(impulse_saw());
    (void)saw.settled(1.0_mm_per_s);
    for (int i = 0; i < 20; ++i) EXPECT_EQ(saw.go(0.0), 0.0);
}

TEST(ImpulseSaw, RemovesWhatItsTeethSweep) {
    Feeding saw(impulse_saw(), Simulation::dt, 0.25_mm);
    (void)saw.settled(1.0_mm_per_s);
    saw.simulation.finish();
    // 24 mm × kerf 1 mm × depth
    EXPECT_NEAR(saw.simulation.present().removed() / (24.0_mm * 1.0_mm * saw.depth), 1.0, 0.01);
}

TEST(ImpulseSaw, StillOnlyTouches) {
    Feeding saw(impulse_saw({{"stroke_rate", 0.0}}));
    double thrust = 0.0;
    while (saw.depth < 0.1_mm) thrust = saw.go(1.0_mm_per_s);
    EXPECT_GT(thrust, 5.0);
    EXPECT_LT(thrust, 500.0);
    saw.simulation.finish();
    EXPECT_EQ(saw.simulation.present().removed(), 0.0);
}

TEST(ImpulseSaw, WarnsOfATwistToo) {
    Feeding saw(impulse_saw({{"torque_threshold", 5.0_Nmm}, {"blade_height", 8.0_mm}}));
    while (saw.depth < 10.0_mm) (void)saw.go(8.0_mm_per_s);
    bool has_warned = false;
    const Pose still = saw.simulation.world_from_tool();
    for (int i = 0; i < 500; ++i) {
        const TickResult r =
            saw.simulation.tick_direct({still * Pose{{0, 0, 0}, quat_from_rotation_vector({i * 0.01_deg, 0, 0})}});
        for (std::size_t e = 0; e < r.event_count; ++e)
            has_warned = has_warned || std::string(r.events[e]) == "sawing.twisted";
    }
    EXPECT_TRUE(has_warned);
}

TEST(ImpulseSaw, NeitherAllocatesNorLocksNorThrows) {
    const ToolSetup setup = impulse_saw();
    const Body body = test::tube(5.0_mm, 3.0_mm, 5.0_mm, 0.25_mm);
    HapticLoop haptic{body, setup, test::outline(setup), test::gains(), test::at_depth(-1.0_mm, 0.0, {0, 0, 5.0_mm})};
    double cut = 0.0;
    for (int i = 0; i < 1000; ++i) {
        const Pose pose = test::at_depth(-1.0_mm + i * 10.0_um, 0.0, {0, 0, 5.0_mm});
        const test::Forbidden before = test::forbidden_here();
        const TickResult result = haptic.tick({pose});
        ASSERT_EQ(test::forbidden_here(), before) << "tick " << i;
        cut = std::max(cut, result.thrust);
        haptic.make_room();
    }
    EXPECT_GT(cut, 1.0);
}

}  // namespace
}  // namespace kerf::papers
