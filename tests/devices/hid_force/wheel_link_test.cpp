// SPDX-License-Identifier: Apache-2.0
// The driver's threads against emulated firmware, on the real clock.
#include "devices/hid_force/wheel_link.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>
#include <thread>

#include "devices/hid/hid_nodes.h"
#include "devices/hid_force/hid_force.h"
#include "kerf/device_exchange.hpp"
#include "tests/devices/driver_rig.h"
#include "tests/devices/hid_force/pid_emulator.h"
#include "tests/support/loop_guard.h"

namespace kerf::hid_force {
namespace {

using namespace std::chrono_literals;
using test::has;
using test::is_valid;

constexpr WheelSetup setup_of_test{
    .full_scale_torque = 2.0, .range = 2.5 * std::numbers::pi, .peak_torque = 1.0, .continuous_torque = 0.5};

/// A system with one device that is not opened yet.
struct Rig {
    std::shared_ptr<test::PidTable> table = std::make_shared<test::PidTable>();

    explicit Rig(const test::Firmware& firmware = test::open_ffboard()) {
        table->device = std::make_shared<test::PidEmulator>(firmware, &device_time);
        table->plug_in("/dev/hidraw3");
    }
    std::unique_ptr<DeviceLink> open(const WheelSetup& setup = setup_of_test, const char* id = "") {
        kerf_device_open_in in{};
        in.id = id;
        return open_wheel(std::make_unique<test::PidTransport>(table), setup, DeviceRequest(in, nullptr, nullptr));
    }
    std::string refusal(const WheelSetup& setup = setup_of_test, const char* id = "") {
        try {
            static_cast<void>(open(setup, id));
        } catch (const std::runtime_error& e) {
            return e.what();
        }
        return {};
    }
    double torque() const { return table->device->torque(); }
};

/// Writes a torque each millisecond until a condition is true, at most 20 s. Returns whether it became true.
bool comes(DeviceLink& link, double torque, const std::function<bool()>& is_so) {
    for (int i = 0; i < 20'000; ++i) {
        kerf_device_command command = command_at_rest();
        command.turn_torque = torque;
        link.write(command);
        if (is_so()) return true;
        std::this_thread::sleep_for(1ms);
    }
    return false;
}

double seconds_to(const std::function<void()>& work) {
    const double start = device_time();
    work();
    return device_time() - start;
}

TEST(WheelLink, StatesWhatTheStationAllows) {
    Rig rig;
    const auto link = rig.open();
    const kerf_device_facts facts = link->facts();
    EXPECT_STREQ(facts.name, "FFBoard");
    EXPECT_EQ(facts.abilities, std::uint32_t{KERF_DEVICE_TURN | KERF_DEVICE_TURN_TORQUE});
    EXPECT_EQ(facts.peak_turn_torque, 1.0);
    EXPECT_EQ(facts.continuous_turn_torque, 0.5);
    EXPECT_NEAR(facts.turn_resolution, 2.5 * std::numbers::pi / 65535, 1e-9);
    EXPECT_TRUE(is_valid(link->read()));
    EXPECT_EQ(link->problem(), "");
}

TEST(WheelLink, MakesTheTorqueThatTheLoopWrites) {
    Rig rig;
    const auto link = rig.open();
    EXPECT_TRUE(comes(*link, 0.5, [&] { return std::abs(rig.torque() - 0.25) < 1e-3; })) << rig.torque();
    EXPECT_TRUE(comes(*link, -7.0, [&] { return std::abs(rig.torque() + 0.5) < 1e-3; })) << "limited to 1 N m of 2";
    EXPECT_TRUE(comes(*link, std::numeric_limits<double>::quiet_NaN(), [&] { return rig.torque() == 0.0; }));
    EXPECT_EQ(rig.table->device->fault(), "");
}

TEST(WheelLink, MakesNoTorqueForASilentLoop) {
    Rig rig;
    const auto link = rig.open();
    ASSERT_TRUE(comes(*link, 1.0, [&] { return rig.torque() > 0.4; }));
    const double start = device_time();
    while (rig.torque() != 0.0 && device_time() < start + 5.0) std::this_thread::sleep_for(1ms);
    EXPECT_EQ(rig.torque(), 0.0);
}

TEST(WheelLink, FollowsAKnobOverManyTurns) {
    Rig rig(test::sparse_knob());
    const auto link = rig.open(
        {.full_scale_torque = 2.0, .range = 2.0 * std::numbers::pi, .peak_torque = 1.0, .continuous_torque = 0.5});
    constexpr std::int64_t twelfth = 0x1000000 / 12;
    for (int i = 0; i <= 36; ++i) rig.table->device->turn_to(i % 12 * twelfth);
    EXPECT_TRUE(comes(*link, 0.0, [&] { return std::abs(link->read().turn - 6.0 * std::numbers::pi) < 1e-3; }))
        << link->read().turn;
    EXPECT_EQ(link->read().reports, 37u);
}

TEST(WheelLink, TurnsRoundWhatTheStationReverses) {
    Rig rig;
    WheelSetup setup = setup_of_test;
    setup.is_reversed = true;
    {
        const auto link = rig.open(setup);
        rig.table->device->turn_to(0);
        rig.table->device->turn_to(1000);
        EXPECT_TRUE(comes(*link, 1.0, [&] { return link->read().turn < 0.0 && rig.torque() < -0.1; }));
    }
    setup.is_torque_reversed = true;
    const auto link = rig.open(setup);
    EXPECT_TRUE(comes(*link, 1.0, [&] { return rig.torque() > 0.1; }));
}

TEST(WheelLink, TurnsWhereItsTorquePushes) {
    for (const bool is_reversed : {false, true}) {
        Rig rig;
        WheelSetup setup = setup_of_test;
        setup.is_reversed = is_reversed;
        const auto link = rig.open(setup);
        std::int64_t counts = 0;
        EXPECT_TRUE(comes(*link, 1.0,
                          [&] {
                              counts += std::llround(100.0 * rig.torque());  // a wheel that follows its motor
                              rig.table->device->turn_to(counts);
                              return link->read().turn > 0.1;
                          }))
            << is_reversed << link->read().turn;
        EXPECT_EQ(counts < 0, is_reversed);
    }
}

TEST(WheelLink, IsLostWhenUnpluggedAndComesBack) {
    Rig rig;
    const auto link = rig.open();
    rig.table->device->turn_to(0);
    rig.table->device->turn_to(1000);
    ASSERT_TRUE(comes(*link, 1.0, [&] { return rig.torque() > 0.1 && link->read().reports == 2; }));
    const double turn = link->read().turn;
    rig.table->unplug();
    EXPECT_TRUE(comes(*link, 1.0, [&] { return !is_valid(link->read()) && has(link->problem(), "unplugged"); }));
    EXPECT_EQ(rig.torque(), 0.0);
    rig.table->plug_in("/dev/hidraw5", "another");
    rig.table->plug_in("/dev/hidraw7");
    EXPECT_TRUE(comes(*link, 1.0, [&] { return is_valid(link->read()); }));
    rig.table->device->turn_to(-20000);
    EXPECT_TRUE(comes(*link, 1.0, [&] { return link->read().reports == 3; }));
    EXPECT_EQ(link->read().turn, turn) << "what it turned while it was away does not count";
    EXPECT_LT(std::abs(rig.torque()), 0.4) << "the gain rises again from zero";
    EXPECT_TRUE(comes(*link, 1.0, [&] { return rig.torque() > 0.49; }));
    EXPECT_EQ(link->problem(), "");
}

TEST(WheelLink, ClosesWithoutTorque) {
    Rig rig;
    auto link = rig.open();
    ASSERT_TRUE(comes(*link, 1.0, [&] { return rig.torque() > 0.1; }));
    EXPECT_LT(seconds_to([&] { link.reset(); }), 0.15);
    EXPECT_EQ(rig.torque(), 0.0);
    EXPECT_EQ(rig.table->device->blocks(), 0u);
    EXPECT_FALSE(rig.table->device->was_disabled());
    EXPECT_FALSE(rig.table->is_in_use());
}

TEST(WheelLink, DoesNotWaitForABlockedWriteWhenClosing) {
    Rig rig;
    auto link = rig.open();
    ASSERT_TRUE(comes(*link, 1.0, [&] { return rig.torque() > 0.1; }));
    rig.table->block_writes(2.0);
    ASSERT_TRUE(comes(*link, 0.5, [&] {
        const std::lock_guard lock(rig.table->mutex);
        return rig.table->writers > 0;
    }));
    EXPECT_LT(seconds_to([&] { link.reset(); }), 0.2);
    rig.table->block_writes(0.0);
    const double start = device_time();
    while (rig.table.use_count() > 1 && device_time() < start + 20.0) std::this_thread::sleep_for(1ms);
    EXPECT_EQ(rig.table.use_count(), 1) << "the write has returned, and its thread has ended";
    EXPECT_EQ(rig.torque(), 0.0);
    EXPECT_FALSE(rig.table->is_in_use());
}

TEST(WheelLink, DoesNotStartAnOldForceAfterABlockedWrite) {
    // Given a wheel with a torque, whose writes block for longer than its effect lasts just after a start of it
    Rig rig;
    const auto link = rig.open();
    ASSERT_TRUE(comes(*link, 1.0, [&] { return rig.torque() >= 0.5; }));
    const std::size_t before = rig.table->device->outputs().size();
    ASSERT_TRUE(comes(*link, 1.0, [&] { return rig.table->device->outputs().size() > before; }));
    rig.table->block_writes(0.3);
    ASSERT_TRUE(comes(*link, 0.9, [&] {
        const std::lock_guard lock(rig.table->mutex);
        return rig.table->writers > 0;
    }));

    // When the loop ends
    std::this_thread::sleep_for(150ms);

    // Then the effect that has ended stays so
    for (const double start = device_time(); device_time() < start + 1.5; std::this_thread::sleep_for(1ms))
        ASSERT_EQ(rig.torque(), 0.0) << device_time() - start;
    rig.table->block_writes(0.0);
}

TEST(WheelLink, IsTakenOnce) {
    Rig rig;
    const auto link = rig.open();
    EXPECT_TRUE(has(rig.refusal(), "in use by another program"));
    test::PidTransport other(rig.table);
    const auto found = find_wheels(&other);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_TRUE(has(found.front().problem, "in use"));
    EXPECT_TRUE(comes(*link, 1.0, [&] { return rig.torque() > 0.1; })) << "the first one goes on";
}

TEST(WheelLink, ShowsWhatHindersTheDevice) {
    Rig rig;
    const auto link = rig.open();
    rig.table->device->send_input({2, 0x02});
    EXPECT_TRUE(comes(*link, 0.0, [&] { return has(link->problem(), "no power"); }));
    rig.table->device->send_input({2, 0x1a});
    EXPECT_TRUE(comes(*link, 0.0, [&] { return link->problem().empty(); })) << "it never had a safety switch";
    rig.table->device->send_input({2, 0x0e});
    rig.table->device->send_input({2, 0x0a});
    EXPECT_TRUE(comes(*link, 0.0, [&] { return has(link->problem(), "safety switch"); }));
}

TEST(WheelLink, RefusesWhatItCannotDrive) {
    Rig rig;
    WheelSetup bare = setup_of_test;
    bare.full_scale_torque = 0.0;
    EXPECT_TRUE(has(rig.refusal(bare), "full_scale_torque"));
    bare = setup_of_test;
    bare.range = 0.0;
    EXPECT_TRUE(has(rig.refusal(bare), "range"));
    EXPECT_TRUE(has(rig.refusal(setup_of_test, "W9"), "there is `W1`"));
    rig.table->device->pending_loads = 1000;
    EXPECT_TRUE(has(rig.refusal(), "does not answer"));
    EXPECT_FALSE(rig.table->is_in_use());
    rig.table->unplug();
    EXPECT_TRUE(has(rig.refusal(), "is connected. Plug one in"));

    test::Firmware liar = test::open_ffboard();
    liar.descriptor.resize(liar.descriptor.size() - 1);
    Rig cut(liar);
    EXPECT_TRUE(has(cut.refusal(), "is connected. Plug one in")) << "a descriptor without end is no device's";
}

TEST(WheelLink, NamesTheRuleThatAUserNeeds) {
    Rig rig;
    rig.table->refusal = hid::refusal_of_node("/dev/hidraw3", EACCES);
    EXPECT_TRUE(has(rig.refusal(), "Add a udev rule for 1209:ffb0"));
    EXPECT_LT(rig.refusal().size(), sizeof kerf_device_found::problem);
}

TEST(WheelLink, ListsADeviceOnceWithItsProblem) {
    test::Firmware deaf = test::open_ffboard();
    for (std::size_t i = 0; i + 2 < deaf.descriptor.size(); ++i)  // `magnitude` becomes another usage
        if (deaf.descriptor[i] == 0x09 && deaf.descriptor[i + 1] == 0x70 && deaf.descriptor[i + 2] == 0x16)
            deaf.descriptor[i + 1] = 0x71;
    Rig rig(deaf);
    test::PidTransport transport(rig.table);
    const auto found = find_wheels(&transport);
    ASSERT_EQ(found.size(), 1u) << "each of its collections is an entry";
    EXPECT_EQ(found.front().id, "W1");
    EXPECT_EQ(found.front().name, "FFBoard, /dev/hidraw3");
    EXPECT_TRUE(has(found.front().problem, "`magnitude` is missing"));
    EXPECT_TRUE(has(rig.refusal(), "`magnitude` is missing"));
    EXPECT_TRUE(has(find_wheels(nullptr).front().problem, "libhidapi-dev"));
}

TEST(WheelLink, ReadsAndWritesWithoutAllocationOrLock) {
    Rig rig;
    const auto link = rig.open();
    const test::Forbidden before = test::forbidden_here();
    for (int i = 0; i < 1000; ++i) {
        static_cast<void>(link->read());
        link->write({});
    }
    EXPECT_EQ(test::forbidden_here(), before);
}

TEST(HidForce, RefusesSettingsThatItDoesNotHave) {
    const HidForce driver{};
    EXPECT_TRUE(has(test::refusal_of_device(driver, {{"reverse", "maybe"}}), "Write yes or no"));
    EXPECT_TRUE(has(test::refusal_of_device(driver, {{"colour", "red"}}), "`reverse_torque`"));
}

}  // namespace
}  // namespace kerf::hid_force
