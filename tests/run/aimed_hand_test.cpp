// SPDX-License-Identifier: Apache-2.0
#include "run/device/aimed_hand.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>

#include "core/haptics/loop/tick_result.h"
#include "run/device/deflection_response.h"
#include "run/device/device_hand.h"
#include "tests/run/device_double.h"

namespace kerf::run {
namespace {

constexpr double dt = 1e-3;
constexpr double mm = 1e-3;
const double nan_value = std::numeric_limits<double>::quiet_NaN();

// ---- response ------------------------------------------------------------------------------------------------------

TEST(DeflectionResponse, IsContinuousOddAndMonotone) {
    constexpr double zone = 0.1, step = 1e-4;
    double before = -1.0;
    EXPECT_EQ(without_dead_zone(1.0, zone), 1.0);
    EXPECT_EQ(without_dead_zone(zone, zone), 0.0);
    for (double d = -1.0; d <= 1.0; d += step) {
        const double now = eased(without_dead_zone(d, zone));
        EXPECT_GE(now, before);
        EXPECT_LT(now - before, 3.0 * step) << "no jump at " << d;
        EXPECT_EQ(eased(without_dead_zone(-d, zone)), -now);
        before = now;
    }
    EXPECT_EQ(without_dead_zone(7.0, zone), 1.0) << "beyond the range";
}

// ---- the hand
// --------------------------------------------------------------------------------------------------------

documents::DeviceStation station() {
    documents::DeviceStation station = station_in_world();
    station.speed = 20.0 * mm;
    return station;
}
Arm arm() { return {.plant = {.arm_stiffness = 600.0, .resolution = 0.0}, .max_push = 10.0}; }

/// A hand at the origin.
struct Rig {
    AimedHand hand{station(), arm(), identity_pose(), dt};
    Pose pose = identity_pose();

    void hold(Vec3 along, Vec3 about, double seconds, const DeviceCommand& command = {}) {
        for (int i = 0; i < std::lround(seconds / dt); ++i) pose = hand.step(along, about, command);
    }
};

DeviceCommand pushing_back(double force) {
    DeviceCommand command;
    command.wrench = make_vec6({-force, 0, 0}, {});
    return command;
}

TEST(AimedHand, MovesAtTheSpeedOfAFullDeflection) {
    Rig rig;
    rig.hold({1, 0, 0}, {}, 1.0);
    const double before = rig.pose.position.x;
    rig.hold({1, 0, 0}, {}, 1.0);
    EXPECT_NEAR(rig.pose.position.x - before, 20.0 * mm, 0.1 * mm);
    EXPECT_EQ(rig.pose.position.y, 0.0);
}

TEST(AimedHand, RestsWithinTheDeadZone) {
    Rig rig;
    rig.hold({0.1, -0.1, 0.1}, {0.1, 0.1, -0.1}, 5.0);
    EXPECT_EQ(length(rig.pose.position), 0.0);
    EXPECT_EQ(rig.pose.rotation.w, 1.0);
}

TEST(AimedHand, StopsWhenTheCapIsReleased) {
    Rig rig;
    rig.hold({1, 0, 0}, {}, 1.0);
    const double released = rig.pose.position.x;
    rig.hold({}, {}, 1.0);
    EXPECT_LT(rig.pose.position.x - released, 3.0 * mm);
    const double rest = rig.pose.position.x;
    rig.hold({}, {}, 1.0);
    EXPECT_NEAR(rig.pose.position.x, rest, 0.01 * mm);
}

TEST(AimedHand, TurnsAboutTheTip) {
    Rig rig;
    rig.hold({}, {0, 0, 1}, 1.0);
    EXPECT_NEAR(small_rotation_vector(rig.pose.rotation).z, pi / 6.0, 0.01);
    EXPECT_EQ(length(rig.pose.position), 0.0);
}

TEST(AimedHand, FollowsTheAxesAndTheScaleOfTheStation) {
    documents::DeviceStation turned;  // seen from behind: right is -x, up is +z, towards the user is +y
    turned.scale = 0.5;
    AimedHand hand(turned, arm(), identity_pose(), dt);
    Pose pose = identity_pose();
    for (int i = 0; i < 2000; ++i) pose = hand.step({0, 1, 0}, {}, {});
    EXPECT_NEAR(pose.position.z, 20.0 * mm, 1.0 * mm) << "10 mm/s";
    EXPECT_NEAR(pose.position.x, 0.0, 1e-12);
}

TEST(AimedHand, PushesWithTheFractionThatTheCapSets) {
    // A constant force of the bone against the hand.
    const auto is_held = [](double deflection, double bone) {
        Rig rig;
        rig.hold({deflection, 0, 0}, {}, 8.0, pushing_back(bone));
        return rig.pose.position.x < 0.0;
    };
    EXPECT_TRUE(is_held(1.0, 10.2)) << "the maximum, and what the friction takes";
    EXPECT_FALSE(is_held(1.0, 9.0));
    const double half = 0.1 + 0.9 * std::sqrt(0.5);  // half of the full speed
    EXPECT_TRUE(is_held(half, 5.2));
    EXPECT_FALSE(is_held(half, 4.0));
}

TEST(AimedHand, EndsThePushWhenTheCapIsReversed) {
    Rig rig;
    for (int i = 0; i < 3000; ++i) rig.pose = rig.hand.step({1, 0, 0}, {}, pushing_back(1e3 * rig.pose.position.x));
    const double pushed = rig.pose.position.x;
    EXPECT_GT(pushed, 5.0 * mm) << "a spring of 1 N/mm";
    for (int i = 0; i < 300; ++i) rig.pose = rig.hand.step({-1, 0, 0}, {}, pushing_back(1e3 * rig.pose.position.x));
    EXPECT_LT(rig.pose.position.x, 0.3 * pushed);
}

TEST(AimedHand, PushesNoHarderThanArmDeviceAndHands) {
    DeviceRecord device = *find_device("premium-1.5-6dof");
    EXPECT_EQ(arm_at(device, 1.0).max_push, device.peak_force);
    EXPECT_EQ(arm_at(device, 1.0 / 200.0).max_push, 2.5);
    device.peak_force = 100.0;
    EXPECT_EQ(arm_at(device, 1.0).max_push, 30.0);
}

// ---- the hand behind a device
// ------------------------------------------------------------------------------------------

kerf_device_facts facts_of_cap() {
    kerf_device_facts facts{};
    facts.abilities = KERF_DEVICE_DEFLECTION;
    facts.button_count = 3;
    return facts;
}

kerf_device_state deflected(double x, std::uint32_t buttons = 0) {
    kerf_device_state state{};
    state.flags = KERF_DEVICE_VALID;
    state.buttons = buttons;
    state.deflection[0] = x;
    return state;
}

TEST(DeflectedDeviceHand, IsAtRestWhileTheDeviceIsSilent) {
    DeviceHand hand(station(), facts_of_cap(), identity_pose(), arm());
    kerf_device_state silent = deflected(0.0);
    silent.age = 3600.0;
    EXPECT_FALSE(hand.take(silent, {}).is_lost);
    EXPECT_TRUE(hand.take({}, {}).is_lost) << "it is unplugged";
    EXPECT_TRUE(hand.take(deflected(nan_value), {}).is_lost);
    EXPECT_TRUE(hand.take(deflected(1.5), {}).is_lost);
    EXPECT_TRUE(hand.is_silent(3));
}

TEST(DeflectedDeviceHand, StopsWhereItIsWhenTheDeviceIsLost) {
    DeviceHand hand(station(), facts_of_cap(), identity_pose(), arm());
    Pose before = identity_pose();
    for (int i = 0; i < 1000; ++i) before = hand.take(deflected(1.0, 1), {}).world_from_handle;
    EXPECT_GT(before.position.x, 10.0 * mm);
    EXPECT_TRUE(hand.presses().is_driving);
    const DeviceSample lost = hand.take({}, {});
    EXPECT_EQ(length(lost.world_from_handle.position - before.position), 0.0);
    EXPECT_FALSE(hand.presses().is_driving);
    Pose back = lost.world_from_handle;
    for (int i = 0; i < 1000; ++i) back = hand.take(deflected(0.0), {}).world_from_handle;
    EXPECT_NEAR(length(back.position - before.position), 0.0, 0.1 * mm) << "no jump and no drift";
}

TEST(DeflectedDeviceHand, FeelsTheForceOfTheLoop) {
    DeviceHand hand(station(), facts_of_cap(), identity_pose(), arm());
    TickResult result;
    result.command = pushing_back(2.0);
    Pose pose = identity_pose();
    for (std::uint64_t i = 0; i < 500; ++i) {
        pose = hand.take(deflected(0.0), {}).world_from_handle;
        static_cast<void>(hand.command(result, i));
    }
    EXPECT_LT(pose.position.x, -1.0 * mm) << "bone pushes a hand that does not push";
}

// ---- pedals
// ------------------------------------------------------------------------------------------------------------

/// A device that reports what its test has set.
class SetDevice final : public DeviceLink {
public:
    SetDevice(const kerf_device_facts& facts, const kerf_device_state& state) : facts_(facts), state_(&state) {}
    [[nodiscard]] kerf_device_facts facts() const override { return facts_; }
    [[nodiscard]] kerf_device_state read() noexcept override { return *state_; }
    void write(const kerf_device_command& /*command*/) noexcept override {}

private:
    kerf_device_facts facts_;
    const kerf_device_state* state_;
};

TEST(OpenedDevice, AppendsTheButtonsOfItsPedal) {
    const kerf_device_state of_cap = deflected(0.0, 0xffu);  // more bits than it has buttons
    kerf_device_state of_pedal = deflected(0.0, 4u);
    const auto cap = opened(std::make_unique<SetDevice>(facts_of_cap(), of_cap));
    EXPECT_EQ(cap->record(), nullptr);
    EXPECT_FALSE(cap->is_pedal());
    kerf_device_facts three{};
    three.button_count = 3;
    auto pedal = opened(std::make_unique<SetDevice>(three, of_pedal));
    EXPECT_TRUE(pedal->is_pedal());
    ASSERT_EQ(cap->add_pedal(std::move(pedal)), "");
    EXPECT_EQ(cap->facts().button_count, 6u);
    EXPECT_EQ(cap->read().buttons, 0b100'111u);
    of_pedal.flags = 0;
    EXPECT_EQ(cap->read().buttons, 0b000'111u) << "it is unplugged";
    EXPECT_EQ(cap->read().flags, std::uint32_t{KERF_DEVICE_VALID});
}

TEST(OpenedDevice, RefusesMoreButtonsThanAStationHas) {
    const kerf_device_state rest = deflected(0.0);
    kerf_device_facts many = facts_of_cap();
    many.button_count = 30;
    const auto cap = opened(std::make_unique<SetDevice>(many, rest));
    EXPECT_NE(cap->add_pedal(opened(std::make_unique<SetDevice>(facts_of_cap(), rest))).find("33 buttons"),
              std::string::npos);
    EXPECT_EQ(cap->facts().button_count, 30u);
}

}  // namespace
}  // namespace kerf::run
