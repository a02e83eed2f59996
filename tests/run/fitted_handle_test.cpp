// SPDX-License-Identifier: Apache-2.0
#include "run/device/fitted_handle.h"

#include <gtest/gtest.h>

#include "kerf/device_exchange.hpp"

namespace kerf::run {
namespace {

kerf_device_state report(const Pose& device_from_handle) {
    kerf_device_state state = state_without_report();
    state.device_from_handle = device_from_handle;
    state.flags = KERF_DEVICE_VALID;
    return state;
}

kerf_device_command running(Vec3 force, Vec3 torque = {}) {
    kerf_device_command command = command_at_rest();
    command.force = force;
    command.torque = torque;
    command.flags = KERF_DEVICE_RUNNING;
    return command;
}

TEST(FittedHandle, ReportsWhereTheHandGrips) {
    FittedHandle handle({.grip = {0, 0, 0.04}}, 0.0);
    // A quarter turn about x takes z to -y.
    kerf_device_state state =
        report({{0.1, 0.2, 0.3}, quat_from_rotation_vector({0.5 * 3.14159265358979323846, 0, 0})});
    handle.take(state);
    EXPECT_NEAR(length(state.device_from_handle.position - Vec3{0.1, 0.16, 0.3}), 0.0, 1e-15);
    kerf_device_state lost = report({});
    lost.flags = 0;
    handle.take(lost);
    EXPECT_TRUE(lost.device_from_handle.position == Vec3{}) << "no report is changed that is none";
}

TEST(FittedHandle, MakesThePowerOfTheGripAtTheHandle) {
    FittedHandle handle({.grip = {0.01, -0.02, 0.04}}, 10.0);
    const Quat rotation = quat_from_rotation_vector({0.3, -0.7, 1.1});
    kerf_device_state state = report({{}, rotation});
    handle.take(state);
    const Vec3 force{1, -2, 0.5}, torque{0.02, 0.01, -0.03}, velocity{0.1, 0.2, -0.1}, turn{1, -0.5, 2};
    const kerf_device_command given = handle.give(running(force, torque));
    const Vec3 of_grip = velocity + cross(turn, rotate(rotation, {0.01, -0.02, 0.04}));
    EXPECT_NEAR(dot(given.force, velocity) + dot(given.torque, turn), dot(force, of_grip) + dot(torque, turn), 1e-15);
}

TEST(FittedHandle, MakesNoTorqueBeyondThePeak) {
    FittedHandle handle({.grip = {0, 0, 0.1}}, 0.2);
    kerf_device_state state = report({{}, {1, 0, 0, 0}});
    handle.take(state);
    const kerf_device_command given = handle.give(running({8, 0, 0}));
    EXPECT_NEAR(length(given.torque - Vec3{0, 0.2, 0}), 0.0, 1e-15) << "0.8 N m of the lever";
    EXPECT_EQ(given.force.x, 8.0);
    FittedHandle without({.grip = {0, 0, 0.1}}, 0.0);
    without.take(state);
    EXPECT_TRUE(without.give(running({8, 0, 0})).torque == Vec3{});
}

TEST(FittedHandle, CarriesTheMassFromTheFirstTickAndLetsGoAtTheEnd) {
    FittedHandle handle({.mass = 0.1}, 0.0);
    kerf_device_state state = report({});
    EXPECT_EQ(handle.give(running({})).force.y, 0.0) << "nothing was reported";
    handle.take(state);
    EXPECT_EQ(handle.give(command_at_rest()).force.y, 0.0) << "before the first tick";
    double before = 0.0;
    for (int tick = 0; tick < 1000; ++tick) {
        const double now = handle.give(running({0, 0.5, 0})).force.y - 0.5;
        EXPECT_GE(now, before);
        EXPECT_LE(now - before, 0.002 * 0.981 + 1e-12) << "without a step";
        before = now;
    }
    EXPECT_NEAR(before, 0.981, 1e-12);
    kerf_device_state lost = report({});
    lost.flags = 0;
    handle.take(lost);
    EXPECT_EQ(handle.give(running({})).force.y, 0.0);
    handle.take(state);
    EXPECT_NEAR(handle.give(running({})).force.y, 0.002 * 0.981, 1e-12) << "it rises again";
    EXPECT_EQ(handle.give(command_at_rest()).force.y, 0.0) << "the end";
}

}  // namespace
}  // namespace kerf::run
