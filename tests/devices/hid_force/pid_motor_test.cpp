// SPDX-License-Identifier: Apache-2.0
// The motor against emulated firmware, on a virtual clock.
#include "devices/hid_force/pid_motor.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "devices/hid/report_descriptor.h"
#include "devices/hid_force/turn_counter.h"
#include "tests/devices/hid_force/pid_emulator.h"

namespace kerf::hid_force {
namespace {

using test::Firmware;

/// An open device, whose clock only the test moves.
struct Rig {
    double now = 100.0;  ///< [s]
    std::shared_ptr<test::PidEmulator> device;
    std::shared_ptr<test::PidTable> table = std::make_shared<test::PidTable>();
    test::PidTransport transport{table};
    PidMotor motor;

    explicit Rig(const Firmware& firmware)
        : device(std::make_shared<test::PidEmulator>(firmware, [this] { return now; })),
          motor(transport, find_layout(hid::parse_descriptor(firmware.descriptor).descriptor).layout) {
        table->device = device;
        table->plug_in("/dev/hidraw3");
        EXPECT_EQ(transport.open("/dev/hidraw3"), "");
    }
    /// Steps each millisecond.
    void run(double fraction, double seconds) {
        for (const double end = now + seconds; now < end; now += 1e-3)
            EXPECT_TRUE(motor.step(fraction, now) && motor.renew(now));
    }
    std::size_t count(std::uint8_t id) const {
        std::size_t n = 0;
        for (const auto& report : device->outputs()) n += report[0] == id;
        return n;
    }
};

class EachFirmware : public testing::TestWithParam<Firmware (*)()> {};
INSTANTIATE_TEST_SUITE_P(PidMotor, EachFirmware,
                         testing::Values(&test::open_ffboard, &test::two_axes, &test::sparse_knob));

TEST_P(EachFirmware, MakesTheTorqueAfterARamp) {
    Rig rig(GetParam()());
    ASSERT_EQ(rig.motor.begin(rig.now), "");
    EXPECT_EQ(rig.device->torque(), 0.0);
    rig.run(0.5, 0.5);
    const auto& gain = rig.device->firmware().gain;
    const bool has_gain = gain.id != 0 && !gain.is_ignored;
    EXPECT_NEAR(rig.device->torque(), has_gain ? 0.125 : 0.25, 0.02) << "gain and force are half way up";
    rig.run(0.5, 0.6);
    EXPECT_NEAR(rig.device->torque(), 0.5, 1e-3);
    rig.run(-0.25, 0.002);
    EXPECT_NEAR(rig.device->torque(), -0.25, 1e-3);
    EXPECT_EQ(rig.device->fault(), "");
}

TEST_P(EachFirmware, KeepsTheTorqueWhileItIsDriven) {
    Rig rig(GetParam()());
    ASSERT_EQ(rig.motor.begin(rig.now), "");
    rig.run(0.5, 1.1);
    for (int i = 0; i < 1000; ++i) {
        rig.run(0.5, 1e-3);
        ASSERT_NEAR(rig.device->torque(), 0.5, 1e-3) << i;
    }
}

TEST_P(EachFirmware, LosesTheTorqueWhenTheProgramDies) {
    Rig rig(GetParam()());
    ASSERT_EQ(rig.motor.begin(rig.now), "");
    rig.run(1.0, 1.1);
    EXPECT_NEAR(rig.device->torque(), 1.0, 1e-3);
    rig.now += effect_duration + 1e-3;
    EXPECT_EQ(rig.device->torque(), 0.0);
    rig.now += 3600.0;
    EXPECT_EQ(rig.device->torque(), 0.0);
}

TEST_P(EachFirmware, EndsWithoutTorqueAndWithEnabledMotor) {
    Rig rig(GetParam()());
    ASSERT_EQ(rig.motor.begin(rig.now), "");
    rig.run(1.0, 1.1);
    rig.motor.end();
    EXPECT_EQ(rig.device->torque(), 0.0);
    EXPECT_FALSE(rig.device->was_disabled());
    EXPECT_EQ(rig.device->blocks(), rig.device->firmware().free.id != 0 ? 0u : 1u);
    EXPECT_EQ(rig.device->fault(), "");
}

TEST(PidMotor, StartsInTheOrderOfTheClass) {
    Rig rig(test::open_ffboard());
    ASSERT_EQ(rig.motor.begin(rig.now), "");
    std::vector<std::vector<std::uint8_t>> heads;
    for (const auto& report : rig.device->outputs()) heads.push_back({report[0], report[1]});
    EXPECT_EQ(heads, (std::vector<std::vector<std::uint8_t>>{
                         {0x0c, 8}, {0x0c, 4}, {0x0c, 1}, {0x0d, 0}, {0x01, 1}, {0x05, 1}, {0x0a, 1}}));
}

TEST(PidMotor, EndsWithZeroForceThenStopThenFree) {
    Rig rig(test::open_ffboard());
    ASSERT_EQ(rig.motor.begin(rig.now), "");
    rig.run(1.0, 0.1);
    const std::size_t before = rig.device->outputs().size();
    rig.motor.end();
    const auto all = rig.device->outputs();
    const std::vector<std::vector<std::uint8_t>> last(all.begin() + static_cast<std::ptrdiff_t>(before), all.end());
    EXPECT_EQ(last, (std::vector<std::vector<std::uint8_t>>{{0x05, 1, 0, 0}, {0x0a, 1, 3, 1}, {0x0b, 1}}));
}

TEST(PidMotor, StartsTheEffectAgainAboutEach30Ms) {
    Rig rig(test::open_ffboard());
    ASSERT_EQ(rig.motor.begin(rig.now), "");
    rig.run(0.0, 3.0);
    EXPECT_NEAR(static_cast<double>(rig.count(0x0a)), 100.0, 5.0);
    EXPECT_EQ(rig.count(0x05), 1u) << "a force that stays is sent once";
    EXPECT_NEAR(static_cast<double>(rig.count(0x0d)), 50.0, 5.0) << "the gain rises in steps of 20 ms";
}

TEST(PidMotor, TakesNoNumberForNoTorque) {
    Rig rig(test::open_ffboard());
    ASSERT_EQ(rig.motor.begin(rig.now), "");
    rig.run(1.0, 1.1);
    rig.run(std::numeric_limits<double>::quiet_NaN(), 0.002);
    EXPECT_EQ(rig.device->torque(), 0.0);
}

TEST(PidMotor, WaitsForABlockThatComesLate) {
    Rig rig(test::open_ffboard());
    rig.device->pending_loads = PidMotor::max_polls - 1;
    EXPECT_EQ(rig.motor.begin(rig.now), "");
}

TEST(PidMotor, RefusesADeviceWhoseBlockNeverLoads) {
    Rig rig(test::open_ffboard());
    rig.device->pending_loads = PidMotor::max_polls;
    EXPECT_NE(rig.motor.begin(rig.now).find("does not answer"), std::string::npos);
    rig.motor.end();
    EXPECT_EQ(rig.device->fault(), "") << "an effect that was not created is not stopped";
}

TEST(PidMotor, ResetsADeviceThatOthersHaveFilled) {
    Rig rig(test::open_ffboard());
    rig.device->max_blocks = 1;
    ASSERT_EQ(rig.motor.begin(rig.now), "");
    PidMotor next(rig.transport,
                  find_layout(hid::parse_descriptor(rig.device->firmware().descriptor).descriptor).layout);
    EXPECT_EQ(next.begin(rig.now), "") << "the first one died without freeing its effect";
    EXPECT_EQ(rig.device->blocks(), 1u);
    rig.device->max_blocks = 0;
    EXPECT_NE(next.begin(rig.now).find("no memory"), std::string::npos);
}

TEST(PidMotor, EndsEffectsThatOthersLeftBehind) {
    // Given a device on which a program has left an effect without end
    Rig rig(test::open_ffboard());
    const PidLayout layout = find_layout(hid::parse_descriptor(rig.device->firmware().descriptor).descriptor).layout;
    ASSERT_TRUE(rig.device->take_feature(create_report(layout).data()));
    Report endless = effect_report(layout, 1);
    endless.bytes[3] = endless.bytes[4] = 0xff;
    for (const Report& report : {control_report(layout, layout.control.enable), endless, force_report(layout, 1, 1.0),
                                 operation_report(layout, 1, layout.operation.start)})
        ASSERT_TRUE(rig.device->take_output(report.data()));
    ASSERT_EQ(rig.device->torque(), 1.0);

    // Then it makes no torque after the start
    ASSERT_EQ(rig.motor.begin(rig.now), "");
    rig.run(0.0, 1.1);
    EXPECT_EQ(rig.device->torque(), 0.0);
    EXPECT_EQ(rig.device->blocks(), 1u);
}

TEST(PidMotor, ReportsALostDevice) {
    Rig rig(test::open_ffboard());
    ASSERT_EQ(rig.motor.begin(rig.now), "");
    rig.table->unplug();
    EXPECT_FALSE(rig.motor.step(0.5, rig.now + 0.01));
    EXPECT_NE(rig.motor.begin(rig.now), "");
}

TEST(TurnCounter, FollowsTheShorterPathRound) {
    TurnCounter knob(0, 255, 2.56);  // 0.01 a count
    EXPECT_EQ(knob.take(200), 0.0) << "the first counts are the beginning";
    EXPECT_NEAR(knob.take(250), 0.5, 1e-12);
    EXPECT_NEAR(knob.take(4), 0.6, 1e-12) << "over the end of the range";
    EXPECT_NEAR(knob.take(250), 0.5, 1e-12) << "and back";
    for (int turn = 0; turn < 10; ++turn)
        for (const int counts : {60, 120, 180, 240, 50}) static_cast<void>(knob.take(counts));
    EXPECT_NEAR(knob.turn(), 0.5 + 3.12 + 9 * 2.56, 1e-9);
    knob.restart();
    EXPECT_NEAR(knob.take(128), 0.5 + 3.12 + 9 * 2.56, 1e-9) << "the device was away";
    EXPECT_NEAR(knob.take(8), 0.5 + 3.12 + 9 * 2.56, 1e-9) << "a jump by 1.2 rad";
    EXPECT_NEAR(knob.take(7), 0.5 + 3.11 + 9 * 2.56, 1e-9);
    TurnCounter reversed(-100, 99, -2.0);
    static_cast<void>(reversed.take(0));
    EXPECT_NEAR(reversed.take(10), -0.1, 1e-12);
    EXPECT_NEAR(reversed.resolution(), 0.01, 1e-12);
}

}  // namespace
}  // namespace kerf::hid_force
