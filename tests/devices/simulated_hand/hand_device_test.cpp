// SPDX-License-Identifier: Apache-2.0
#include "devices/simulated_hand/hand_device.h"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <memory>
#include <string>

#include "tests/devices/motion/opened_driver.h"
#include "tests/support/temporary_folder.h"

namespace kerf::simulated_hand {
namespace {

using test::open_with_motion;
using test::pushing;

constexpr int settled = 3000;  // ticks: the arm's oscillation decays with a time constant of 0.23 s

Vec3 position_after(DeviceLink& device, int ticks, Vec3 force) {
    for (int i = 0; i < ticks; ++i) device.write(pushing(force));
    return device.read().device_from_handle.position;
}

TEST(HandDevice, KeepsTheHandleAtTheOriginWithoutAMotion) {
    const auto device = open_with_motion<HandDevice>("");
    EXPECT_EQ(length(position_after(*device, settled, {})), 0.0);
    EXPECT_EQ(device->read().flags, std::uint32_t{KERF_DEVICE_VALID});
}

TEST(HandDevice, YieldsByForceOverStiffness) {
    const auto device = open_with_motion<HandDevice>("");
    // 2.7 N on an arm of 135 N/m: 20 mm.
    const Vec3 yielded = position_after(*device, settled, {0.0, 2.7, 0.0});
    EXPECT_EQ(plant_of_device().arm_stiffness, 135.0);
    EXPECT_NEAR(yielded.y, 20e-3, 2.0 * plant_of_device().resolution);
    EXPECT_EQ(yielded.x, 0.0);
    EXPECT_NEAR(length(position_after(*device, settled, {})), 0.0, 2.0 * plant_of_device().resolution);
}

TEST(HandDevice, FollowsTheMotionOfItsFile) {
    const test::TemporaryFolder folder;
    const std::string file = folder / "motion.csv";
    std::ofstream(file) << "0,0.01,0,0,1,0,0,0,0\n0.5,0.03,0,0,0,0,0,1,2\n10,0.03,0,0,0,0,0,1,2\n";
    const auto device = open_with_motion<HandDevice>(file);
    EXPECT_EQ(device->facts().button_count, 2u);
    EXPECT_EQ(device->read().device_from_handle.position.x, 0.01) << "it begins at the first row";
    EXPECT_EQ(device->read().buttons, 0u);
    const Vec3 end = position_after(*device, 5000, {});
    EXPECT_NEAR(end.x, 0.03, 2.0 * plant_of_device().resolution);
    EXPECT_NEAR(std::abs(device->read().device_from_handle.rotation.z), 1.0, 1e-9) << "half a turn at 1 rad/s";
    EXPECT_EQ(device->read().buttons, 2u);
    EXPECT_EQ(device->read().reports, 6u) << "each read is a report";
}

TEST(HandDevice, RestsUntilTheFirstTick) {
    const auto device = open_with_motion<HandDevice>("");
    kerf_device_command before = pushing({5, 0, 0});
    before.flags = KERF_DEVICE_FORCE_ON;
    for (int i = 0; i < 100; ++i) device->write(before);
    EXPECT_EQ(length(device->read().device_from_handle.position), 0.0);
}

TEST(HandDevice, LimitsTheForceToItsPeak) {
    const auto device = open_with_motion<HandDevice>("");
    const double peak = device->facts().peak_force;
    const Vec3 far = position_after(*device, settled, {1e308, 0, 0});
    EXPECT_NEAR(far.x, peak / 135.0, 2.0 * plant_of_device().resolution);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NEAR(position_after(*device, settled, {nan, 1, 1}).x, 0.0, 2.0 * plant_of_device().resolution);
}

TEST(HandDevice, GivesTheSameReportsForTheSameCommands) {
    const auto one = open_with_motion<HandDevice>(""), other = open_with_motion<HandDevice>("");
    for (int i = 0; i < 500; ++i) {
        const kerf_device_command command = pushing({0.01 * i, -0.3, 1e-3 * i});
        one->write(command);
        other->write(command);
        const Vec3 apart = one->read().device_from_handle.position - other->read().device_from_handle.position;
        EXPECT_EQ(length(apart), 0.0);
    }
}

}  // namespace
}  // namespace kerf::simulated_hand
