// SPDX-License-Identifier: Apache-2.0
// A handle and its tool in a station whose axes, scale and grip are none of the identity.
#include "run/device/handle_frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "core/haptics/loop/tick_result.h"
#include "kerf/units.hpp"
#include "run/device/device_hand.h"

namespace kerf::run {
namespace {

using namespace literals;

constexpr Vec3 grip{0, 0, -100.0_mm};
constexpr double scale = 0.25;
const Pose handle{{0.01, 0.02, -0.03}, quat_from_rotation_vector({0.3, 0.2, -0.4})};
const Pose tool{{0.1, -0.2, 0.3}, quat_from_rotation_vector({0.4, -0.9, 0.5})};

/// The device's x leads to the patient's head, its y to the back, so its z to the left.
documents::DeviceStation station() { return {.right = {0, 0, 1}, .up = {0, 1, 0}, .scale = scale}; }
constexpr Vec3 to_world(Vec3 device) { return {-device.z, device.y, device.x}; }

struct Joined {
    HandleFrame frame;

    explicit Joined(bool has_rotation = true) : frame(station(), has_rotation) { frame.join(handle, tool, grip); }
};

void expect_near(Vec3 is, Vec3 wanted, double tolerance = 1e-12) {
    EXPECT_NEAR(is.x, wanted.x, tolerance);
    EXPECT_NEAR(is.y, wanted.y, tolerance);
    EXPECT_NEAR(is.z, wanted.z, tolerance);
}
void expect_same_turn(const Quat& is, const Quat& wanted) {
    for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}}) expect_near(rotate(is, axis), rotate(wanted, axis));
}

TEST(HandleFrame, HasNoJumpWhereItIsJoined) {
    const Pose there = Joined().frame.tool_for(handle);
    expect_near(there.position, tool.position);
    expect_same_turn(there.rotation, tool.rotation);
}

TEST(HandleFrame, MovesTheGripByTheScaledMotion) {
    const Vec3 motion{8.0_mm, -4.0_mm, 12.0_mm};
    for (const bool has_rotation : {true, false}) {
        const Pose there = Joined(has_rotation).frame.tool_for({handle.position + motion, handle.rotation});
        expect_near(there.position - tool.position, scale * to_world(motion));
        expect_same_turn(there.rotation, tool.rotation);
    }
}

TEST(HandleFrame, TurnsTheToolAboutItsGrip) {
    const Vec3 turn{0.1, -0.2, 0.05};  // about the device's axes
    const Pose there = Joined().frame.tool_for({handle.position, quat_from_rotation_vector(turn) * handle.rotation});
    const Quat of_world = quat_from_rotation_vector(to_world(turn));
    expect_same_turn(there.rotation, of_world * tool.rotation);
    expect_near(there * grip, tool * grip);
}

TEST(HandleFrame, DoesNotTurnTheToolByADeviceWithoutRotation) {
    const Pose there = Joined(false).frame.tool_for({handle.position, quat_from_rotation_vector({0.5, 0, 0})});
    expect_near(there.position, tool.position);
    expect_same_turn(there.rotation, tool.rotation);
}

TEST(HandleFrame, PutsTheGripOfTheToolAtTheHandle) {
    const Joined joined;
    const Pose moved{{-0.04, 0.05, 0.02}, quat_from_rotation_vector({-0.3, 0.4, 0.1})};
    for (const Pose& at : {handle, moved}) {
        const Pose device_from_tool = joined.frame.to_device(joined.frame.tool_for(at));
        expect_near(device_from_tool * grip, at.position);
    }
    // In the device's axes the tool turns as the handle does
    const Quat before = joined.frame.to_device(joined.frame.tool_for(handle)).rotation,
               after = joined.frame.to_device(joined.frame.tool_for(moved)).rotation;
    expect_same_turn(after * conjugate(before), moved.rotation * conjugate(handle.rotation));
}

TEST(HandleFrame, GivesAForceInTheDevicesAxes) {
    const Vec3 in_device{1.0, 2.0, 4.0};
    expect_near(Joined().frame.to_device(to_world(in_device)), in_device);
}

TEST(HandleFrame, ForgetsTheFirstPosesWhenJoinedAgain) {
    Joined joined;
    const Pose elsewhere{{-0.2, 0.1, 0.4}, quat_from_rotation_vector({1.0, 0.3, 0.2})};
    joined.frame.join(elsewhere, tool, 0.5 * grip);
    const Pose there = joined.frame.tool_for(elsewhere);
    expect_near(there.position, tool.position);
    expect_same_turn(there.rotation, tool.rotation);
    expect_near(joined.frame.to_device(there) * (0.5 * grip), elsewhere.position);
}

// ---- what the device gets ------------------------------------------------------------------------------------------

struct AtDevice {
    DeviceHand hand;
    kerf_device_state state{};

    AtDevice() : hand(station(), facts(), tool) {
        state.flags = KERF_DEVICE_VALID;
        state.device_from_handle = handle;
    }
    static kerf_device_facts facts() {
        kerf_device_facts facts{};
        facts.abilities = KERF_DEVICE_POSITION | KERF_DEVICE_ROTATION | KERF_DEVICE_FORCE;
        facts.button_count = 4;
        return facts;
    }
};

TEST(DeviceHand, SendsEachPartOfTheCommandInTheDevicesAxes) {
    AtDevice at;
    (void)at.hand.take(at.state, grip);
    TickResult result;
    result.world_from_tool = tool;
    result.command.wrench = make_vec6(to_world({1.0, 2.0, 3.0}), to_world({0.1, 0.2, 0.3}));
    result.limited_on_hand = {9, 9, 9, 9, 9, 9};
    const kerf_device_command command = at.hand.command(result, 42);
    EXPECT_EQ(command.tick, 42u);
    expect_near({command.force.x, command.force.y, command.force.z}, {1.0, 2.0, 3.0});
    expect_near({command.torque.x, command.torque.y, command.torque.z}, {0.1, 0.2, 0.3});
    expect_near(Pose(command.device_from_tool) * grip, handle.position);
}

TEST(DeviceHand, StatesRunningAndForceEachAlone) {
    constexpr std::uint32_t running = KERF_DEVICE_RUNNING, force = KERF_DEVICE_FORCE_ON;
    AtDevice at;
    TickResult result;
    EXPECT_EQ(at.hand.command(result, 0).flags, force) << "before the first report";
    (void)at.hand.take(at.state, grip);
    EXPECT_EQ(at.hand.command(result, 1).flags, running | force);
    result.is_coming_back = true;
    EXPECT_EQ(at.hand.command(result, 2).flags, running);
    result.is_coming_back = false;
    result.is_closed_or_closing = true;
    EXPECT_EQ(at.hand.command(result, 3).flags, running);
}

TEST(DeviceHand, JoinsTheHandleAgainWhereverItComesBack) {
    AtDevice at;
    (void)at.hand.take(at.state, grip);
    for (const double away : {50.0_mm, -80.0_mm}) {
        at.state.flags = 0;
        EXPECT_TRUE(at.hand.take(at.state, grip).is_lost);
        at.state.flags = KERF_DEVICE_VALID;
        at.state.device_from_handle.position.x += away;
        const DeviceSample back = at.hand.take(at.state, grip);
        EXPECT_FALSE(back.is_lost);
        expect_near(back.world_from_handle.position, tool.position);
    }
}

TEST(DeviceHand, TakesAReportOfTwentyMillisecondsForTheLast) {
    AtDevice at;
    at.state.age = 20e-3;
    EXPECT_FALSE(at.hand.take(at.state, grip).is_lost);
    at.state.age = 20.1e-3;
    EXPECT_TRUE(at.hand.take(at.state, grip).is_lost);
}

}  // namespace
}  // namespace kerf::run
