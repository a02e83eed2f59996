// SPDX-License-Identifier: Apache-2.0
// Device, hand and shaft as one spring, held against their sum worked out by hand.
#include "core/haptics/law/compliance.h"

#include <gtest/gtest.h>

#include <optional>

#include "core/haptics/loop/coupling.h"
#include "kerf/units.hpp"

namespace kerf {
namespace {

using namespace literals;

constexpr double grip = 120.0_mm;
constexpr const char* devices[] = {"touch", "desktop", "premium-1.5-6dof", "omega.6"};

/// [N/m] with which the tip gives way to a force across it.
double stiffness_at_tip(const Spring& spring) {
    return 1.0 / (1.0 / spring.stiffness.across + spring.centre_z * spring.centre_z / spring.turn_stiffness.across);
}

Spring held(const char* device, double scale, TipBending tip = {}) {
    return combined_spring(gains_for(*find_device(device), scale), one_hand, -grip, tip);
}

TEST(Compliance, OfAWristIsItsLeverSquared) {
    // 10 N·m/rad, 120 mm behind the tip: 10/0.12² = 694 N/m, and 1 N turns the tool by 12 mrad
    const Compliance at_tip = at_point_ahead({0.0, 0.0, 1.0 / 10.0}, grip);
    EXPECT_NEAR(1.0 / at_tip.shift, 694.4, 0.1);
    EXPECT_NEAR(at_tip.mixed, 0.012, 1e-12);
    EXPECT_NEAR(at_tip.turn, 0.1, 1e-12);
}

TEST(Compliance, OfABentShaftIsThatOfAForceAtItsTip) {
    // l³/3EI and l²/2EI of 80 mm with 0.497 N·m²; ¾ l/EI turns it
    const double l = 80.0_mm, ei = 0.497;
    const Compliance c = bending_compliance({l * l * l / (3.0 * ei), l * l / (2.0 * ei)});
    EXPECT_NEAR(1.0 / c.shift, 2912.0, 1.0);
    EXPECT_NEAR(c.turn, 0.75 * l / ei, 1e-12);
    EXPECT_EQ(bending_compliance({}).turn, 0.0);
}

TEST(Compliance, OfWristAndBitHasItsCentreBetweenThem) {
    const double l = 80.0_mm, ei = 0.497;
    const TipBending bit{l * l * l / (3.0 * ei), l * l / (2.0 * ei)};
    const CentredSpring spring = centred(at_point_ahead({0.0, 0.0, 0.1}, grip) + bending_compliance(bit));
    // 1.783 mm/N, 18.44 mrad/N, 0.2207 rad/(N·m)
    EXPECT_NEAR(spring.ahead, -83.5_mm, 0.1_mm);
    EXPECT_NEAR(spring.shift, 4.12e3, 0.02e3);
    EXPECT_NEAR(spring.turn, 4.53, 0.01);
}

TEST(Compliance, OfAShiftAndATurnAtOnePointStaysApart) {
    const CentredSpring spring = centred({1.0 / 500.0, 0.0, 1.0 / 4.0});
    EXPECT_DOUBLE_EQ(spring.ahead, 0.0);
    EXPECT_DOUBLE_EQ(spring.shift, 500.0);
    EXPECT_DOUBLE_EQ(spring.turn, 4.0);
}

TEST(Held, TheTipIsAsSoftOnEveryDevice) {
    const double l = 80.0_mm, ei = 0.497;
    const TipBending bit{l * l * l / (3.0 * ei), l * l / (2.0 * ei)};
    for (const char* device : devices)
        for (const double scale : {1.0 / 300.0, 1.0 / 90.0, 1.0 / 40.0}) {
            EXPECT_NEAR(stiffness_at_tip(held(device, scale)), 694.0, 69.0) << device << " at " << scale;
            EXPECT_NEAR(stiffness_at_tip(held(device, scale, bit)), 561.0, 56.0) << device << " at " << scale;
        }
}

TEST(Held, TheShaftIsAsStiffAlongOnEveryDevice) {
    for (const char* device : devices) EXPECT_DOUBLE_EQ(held(device, 1.0 / 100.0).stiffness.along, 7.5e3) << device;
    // Where a device cannot make that in bone, it makes what it can
    const CouplingGains soft = gains_for(*find_device("touch"), 1.0);
    EXPECT_DOUBLE_EQ(combined_spring(soft, one_hand, -grip, {}).stiffness.along, soft.stiffness);
}

TEST(Held, OnlyADeviceThatMakesTorquesAddsToATurn) {
    CouplingGains gains;
    gains.stiffness = 1000.0;
    gains.damping = 4.0;
    gains.has_torque = true;
    EXPECT_NEAR(combined_spring(gains, one_hand, -grip, {}).turn_stiffness.across, 2.5, 1e-12) << "1000 N/m · (50 mm)²";
    gains.has_torque = false;
    EXPECT_NEAR(combined_spring(gains, one_hand, -grip, {}).turn_stiffness.across, 10.0, 1e-12);
}

TEST(Held, NoDamperIsStrongerThanTheDevices) {
    for (const char* device : devices)
        for (const double scale : {1.0, 0.1, 0.01}) {
            const CouplingGains gains = gains_for(*find_device(device), scale);
            const Spring spring = combined_spring(gains, one_hand, -grip, {});
            EXPECT_LE(spring.damping.across, gains.damping / scale) << device;
            EXPECT_LE(spring.damping.along, gains.damping / scale) << device;
        }
}

TEST(Clamped, TheSpringIsTheDevicesOwnAtTheGrip) {
    const CouplingGains gains = gains_for(*find_device("premium-1.5-6dof"), 0.01);
    const Spring spring = combined_spring(gains, std::nullopt, -grip, {});
    EXPECT_DOUBLE_EQ(spring.centre_z, -grip);
    EXPECT_DOUBLE_EQ(spring.stiffness.across, 100.0 * gains.stiffness);
    EXPECT_DOUBLE_EQ(spring.stiffness.along, 100.0 * gains.stiffness);
    EXPECT_DOUBLE_EQ(spring.damping.along, 100.0 * gains.damping);
    EXPECT_DOUBLE_EQ(spring.turn_stiffness.across, 100.0 * gains.stiffness * 2.5e-3);
}

}  // namespace
}  // namespace kerf
