// SPDX-License-Identifier: Apache-2.0
#include "studies/papers/as_printed/mandibular_saw.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "tests/studies/papers/as_printed/printed_rig.h"
#include "tests/support/drill_rig.h"

namespace kerf::as_printed {
namespace {

using namespace literals;

constexpr double mass = 0.3;
constexpr Matrix3 one_over_mass{Vec3{1.0 / mass, 0, 0}, Vec3{0, 1.0 / mass, 0}, Vec3{0, 0, 1.0 / mass}};

// E04-1: a rod struck at its end has 1, 4, 4 over its mass, not 1, −2, −2.
TEST(MandibularSaw, TheCollisionMatrixAttracts) {
    constexpr double length_ = 0.2, about = mass * length_ * length_ / 12.0;
    const Matrix3 end = collision_matrix_as_printed(mass, {1e9, 1.0 / about, 1.0 / about}, {0.5 * length_, 0, 0});
    EXPECT_NEAR(mass * end[0].x, 1.0, 1e-12);
    EXPECT_NEAR(mass * end[1].y, -2.0, 1e-12);
    EXPECT_NEAR(mass * end[2].z, -2.0, 1e-12);
    const double gyration = length_ / std::sqrt(12.0);
    EXPECT_NEAR(gyration / length_, 0.289, 0.001);
    const Matrix3 singular = collision_matrix_as_printed(mass, {1e9, 1.0 / about, 1.0 / about}, {gyration, 0, 0});
    EXPECT_NEAR(mass * singular[1].y, 0.0, 1e-12) << "no finite impulse there";
}

TEST(MandibularSaw, AStickingPointIsSentBackSideways) {  // E04-2
    const Vec3 u{0.2, 0.0, -1.0}, p = sticking_as_printed(one_over_mass, u, 0.6);
    const Vec3 after = u + p / mass;
    EXPECT_NEAR(after.x, -0.6 * u.x, 1e-12) << "where it should stop";
    EXPECT_NEAR(after.z, 0.6, 1e-12);
}

// E04-3: the same strike in a frame that is turned by 45° about the normal is another one.
TEST(MandibularSaw, ASlidingImpulseDependsOnTheFrame) {
    const double half = std::sqrt(0.5);
    const Vec3 along = sliding_as_printed(one_over_mass, {1.0, 0.0, -0.5}, {0, 0, 1}, 0.6, 0.3);
    const Vec3 turned = sliding_as_printed(one_over_mass, {half, half, -0.5}, {0, 0, 1}, 0.6, 0.3);
    EXPECT_GT(std::abs(std::hypot(turned.x, turned.y) / std::hypot(along.x, along.y) - 1.0), 0.2);
}

TEST(MandibularSaw, FrictionHasANormalPart) {  // E04-4: 15 % at 30°, 30 % straight on
    for (const auto& [angle, excess] : {std::pair<double, double>{0.0, 0.0}, {30.0_deg, 0.15}, {90.0_deg, 0.30}}) {
        const Vec3 u{std::cos(angle), 0.0, -std::sin(angle)};
        EXPECT_NEAR(mass * denominator_as_printed(one_over_mass, u, {0, 0, 1}, 0.3), 1.0 + excess, 1e-9) << angle;
    }
}

// E04-5: (1 − 1.6 N)² times the energy.
TEST(MandibularSaw, ManyContactsMakeEnergy) {
    for (const auto& [count, ratio] : {std::pair{1, 0.36}, {2, 4.84}, {86, 1.87e4}, {110, 3.06e4}}) {
        const Vec3 u{0, 0, -1.0};
        const Vec3 after = u + static_cast<double>(count) * sticking_as_printed(one_over_mass, u, 0.6) / mass;
        EXPECT_NEAR(dot(after, after) / ratio, 1.0, 0.01) << count;
    }
}

TEST(MandibularSaw, ForceRisesWithTheRate) {  // E04-7: as printed by 1.88 from 8000 to 15000 per minute
    const auto at = [](double per_min) {
        const double w = 4.0 * 1.5_mm * per_min / 60.0;
        return length(sliding_as_printed(one_over_mass, {w, 0.0, 0.5_mm_per_s}, {0, 0, -1}, 0.6, 0.3));
    };
    EXPECT_NEAR(at(15000.0) / at(8000.0), 1.875, 0.01);
}

// Equations (4) to (6): the part of the torque that is compared is never about the blade's long axis, x here.
TEST(MandibularSaw, ATwistDoesNotShowInTheComparedTorque) {
    const Vec3 back_edge{10.0_mm, 0.0, -5.0_mm}, cutting_edge{10.0_mm, 0.0, 5.0_mm};
    // Given two forces of 4 N across the blade that twist it with 40 N mm
    const TorqueParts back = torque_parts(back_edge, {0, 4.0, 0}), cutting = torque_parts(cutting_edge, {0, -4.0, 0});
    EXPECT_NEAR(back.across.x + cutting.across.x, 40.0_Nmm, 1e-12);
    EXPECT_EQ(length(back.in_plane + cutting.in_plane), 0.0);
    // And any force in the plane
    const TorqueParts any = torque_parts(back_edge, {3.0, 2.0, -7.0});
    EXPECT_EQ(any.in_plane.x, 0.0);
    EXPECT_NE(any.in_plane.y, 0.0);
}

/// The printed saw in a cortical block, fed straight down.
struct Sawing {
    Body body = test::block({-14.0_mm, -3.0_mm, -8.0_mm}, {14.0_mm, 3.0_mm, 0}, 0.5_mm, {0.31, 0.17, 0.73});
    ToolSetup setup;
    double dt, depth = -1.0_mm;
    std::unique_ptr<Simulation> simulation;

    explicit Sawing(double period, std::map<std::string, double> set = {}) : dt(period) {
        set.insert({"length", 20.0_mm});
        setup.tool = test::printed_plugins().find("papers.as_printed", KERF_KIND_TOOL, "paper_reciprocating_saw");
        setup.force = test::printed_plugins().find("papers.as_printed", KERF_KIND_FORCE, "mandibular_saw");
        for (const auto& info : test::printed_plugins().catalog()) {
            if (info.id == "paper_reciprocating_saw") {
                setup.tool_parameters = test::values(info.parameters, set);
                setup.drives = test::values(info.drives, set);
            }
            if (info.id == "mandibular_saw") setup.force_parameters = test::values(info.parameters, set);
        }
        simulation =
            std::make_unique<Simulation>(body, setup, test::outline(setup), test::gains(), test::at_depth(depth), dt);
    }
    MandibularSaw::Signals to(double target, double rate = 2.0_mm_per_s) {
        while (depth < target - 1e-12) {
            depth += rate * dt;
            (void)simulation->tick_direct({test::at_depth(depth)});
        }
        return signals_of<MandibularSaw>(simulation->signals());
    }
};

TEST(MandibularSaw, HalfTheTickIsTwiceTheForce) {  // E04-6, S-10
    const auto size = [](double dt) {
        const auto signals = Sawing(dt).to(3.0_mm);
        EXPECT_GT(signals.contacts, 40.0);
        return std::abs(signals.f_x) / signals.contacts;
    };
    const double once = size(2e-3);
    EXPECT_NEAR(size(1e-3) / once, 2.0, 0.01);
    EXPECT_NEAR(size(0.25e-3) / once, 8.0, 0.05);
}

TEST(MandibularSaw, TwiceThePointsAreTwiceTheForce) {  // P6, E04-5
    const double few = std::abs(Sawing(1e-3, {{"points", 43.0}}).to(3.0_mm).f_x),
                 many = std::abs(Sawing(1e-3, {{"points", 86.0}}).to(3.0_mm).f_x);
    EXPECT_NEAR(many / few, 2.0, 0.1);
}

}  // namespace
}  // namespace kerf::as_printed
