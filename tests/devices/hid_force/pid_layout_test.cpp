// SPDX-License-Identifier: Apache-2.0
#include "devices/hid_force/pid_layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "devices/hid_force/pid_codec.h"
#include "tests/devices/hid_force/pid_firmware.h"

namespace kerf::hid_force {
namespace {

using Bytes = std::vector<std::uint8_t>;

FoundLayout found_in(const Bytes& descriptor) { return find_layout(hid::parse_descriptor(descriptor).descriptor); }
PidLayout layout_of(const test::Firmware& firmware) {
    const FoundLayout found = found_in(firmware.descriptor);
    EXPECT_EQ(found.problem, "");
    return found.layout;
}
Bytes bytes_of(const Report& report) { return {report.bytes.begin(), report.bytes.begin() + report.size}; }

/// Replaces the only occurrence of some bytes.
Bytes with(Bytes all, const Bytes& from, const Bytes& to) {
    const auto at = std::search(all.begin(), all.end(), from.begin(), from.end());
    EXPECT_NE(at, all.end());
    if (at == all.end()) return all;
    EXPECT_EQ(std::search(at + 1, all.end(), from.begin(), from.end()), all.end()) << "it occurs twice";
    const auto begin = all.erase(at, at + static_cast<std::ptrdiff_t>(from.size()));
    all.insert(begin, to.begin(), to.end());
    return all;
}

TEST(PidCodec, WritesTheReportsOfAnOpenFfboard) {
    const PidLayout l = layout_of(test::open_ffboard());
    EXPECT_EQ(bytes_of(control_report(l, l.control.enable)), (Bytes{0x0c, 0x01}));
    EXPECT_EQ(bytes_of(control_report(l, l.control.stop_all)), (Bytes{0x0c, 0x04})) << "a mask: bit 2";
    EXPECT_EQ(bytes_of(control_report(l, l.control.reset)), (Bytes{0x0c, 0x08}));
    EXPECT_EQ(bytes_of(gain_report(l, 0.5)), (Bytes{0x0d, 128}));
    EXPECT_EQ(bytes_of(create_report(l)), (Bytes{0x11, 1, 0, 0}));
    EXPECT_EQ(create_report(l).kind, hid::ReportKind::feature);
    EXPECT_EQ(bytes_of(effect_report(l, 3)),
              (Bytes{0x01, 3, 1, 100, 0, 0, 0, 0, 0, 0, 0, 255, 0, 4, 0x28, 0x23, 0, 0, 0, 0, 0, 0}))
        << "100 ms, full gain, direction enabled, 90 degrees";
    EXPECT_EQ(bytes_of(force_report(l, 3, 0.5)), (Bytes{0x05, 3, 0x00, 0xc0}))
        << "half of 32767 from the east, towards higher counts";
    EXPECT_EQ(bytes_of(operation_report(l, 3, l.operation.start)), (Bytes{0x0a, 3, 1, 1}));
    EXPECT_EQ(bytes_of(operation_report(l, 3, l.operation.stop)), (Bytes{0x0a, 3, 3, 1}));
    EXPECT_EQ(bytes_of(free_report(l, 3)), (Bytes{0x0b, 3}));
}

TEST(PidCodec, WritesDeviceControlAsAListWhereItIsOne) {
    const PidLayout l = layout_of(test::two_axes());
    EXPECT_EQ(bytes_of(control_report(l, l.control.enable)), (Bytes{0x0c, 1}));
    EXPECT_EQ(bytes_of(control_report(l, l.control.stop_all)), (Bytes{0x0c, 3}));
    EXPECT_EQ(bytes_of(effect_report(l, 2)), (Bytes{0x01, 2, 1, 100, 0, 0, 0, 0, 0, 255, 0, 4, 64, 0, 0, 0, 0, 0}))
        << "a quarter of 255";
    EXPECT_EQ(bytes_of(force_report(l, 2, -1.0)), (Bytes{0x05, 2, 0x10, 0x27}));
}

TEST(PidCodec, WritesTheReportsOfASparseKnob) {
    const PidLayout l = layout_of(test::sparse_knob());
    EXPECT_FALSE(l.gain.message.exists());
    EXPECT_FALSE(l.free.message.exists());
    EXPECT_FALSE(l.state.message.exists());
    EXPECT_EQ(bytes_of(control_report(l, l.control.enable)), (Bytes{0x24, 0})) << "it counts from 0";
    EXPECT_EQ(bytes_of(effect_report(l, 5)), (Bytes{0x21, 0x15, 0xe8, 0x03, 1})) << "1000 times 100 us";
    EXPECT_NEAR(l.effect.duration_time, 0.1, 1e-12);
    EXPECT_EQ(bytes_of(force_report(l, 5, 1.0)), (Bytes{0x22, 0x15, 0x80})) << "-2047 in the upper 12 bits";
    EXPECT_EQ(bytes_of(operation_report(l, 5, l.operation.start)), (Bytes{0x23, 0x15}));
}

TEST(PidCodec, LimitsAForceAndTakesNoNumberForNone) {
    const PidLayout l = layout_of(test::open_ffboard());
    EXPECT_EQ(bytes_of(force_report(l, 1, -7.0)), (Bytes{0x05, 1, 0xff, 0x7f}));
    EXPECT_EQ(bytes_of(force_report(l, 1, 7.0)), (Bytes{0x05, 1, 0x01, 0x80}));
    for (const double none : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
        EXPECT_EQ(bytes_of(force_report(l, 1, none)), (Bytes{0x05, 1, 0, 0}));
}

TEST(PidCodec, ReadsTheAnswerToACreation) {
    using Status = BlockLoad::Status;
    const PidLayout l = layout_of(test::open_ffboard());
    const auto read = [&](Bytes bytes) { return read_block_load(l, bytes); };
    EXPECT_EQ(read({0x12, 7, 1, 0, 0}).status, Status::success);
    EXPECT_EQ(read({0x12, 7, 1, 0, 0}).block, 7);
    EXPECT_EQ(read({0x12, 0, 0, 0, 0}).status, Status::pending);
    EXPECT_EQ(read({0x12, 0, 2, 0, 0}).status, Status::full);
    EXPECT_EQ(read({0x12, 0, 3, 0, 0}).status, Status::error);
    EXPECT_EQ(read({0x12, 0, 1, 0, 0}).status, Status::error) << "there is no block 0";
    EXPECT_EQ(read({0x12, 41, 1, 0, 0}).status, Status::error) << "beyond its range";
    EXPECT_EQ(read({0x12, 7, 1, 0}).status, Status::pending) << "cut";
    EXPECT_EQ(read({0x11, 7, 1, 0, 0}).status, Status::pending) << "another report";
    EXPECT_EQ(read({}).status, Status::pending);
}

TEST(PidCodec, ReadsAxisAndState) {
    const PidLayout l = layout_of(test::open_ffboard());
    Bytes axis(25);
    axis[0] = 1;
    axis[9] = 0x18;
    axis[10] = 0xfc;
    EXPECT_EQ(read_axis(l, axis), -1000);
    axis[9] = 0x00;
    axis[10] = 0x80;
    EXPECT_EQ(read_axis(l, axis), std::nullopt) << "-32768 is out of its range";
    EXPECT_EQ(read_axis(l, Bytes{1, 2, 3}), std::nullopt);
    EXPECT_EQ(read_state(l, Bytes{2, 0x0e}, true), Hindrance::none);
    EXPECT_EQ(read_state(l, Bytes{2, 0x0f}, true), Hindrance::paused);
    EXPECT_EQ(read_state(l, Bytes{2, 0x0c}, true), Hindrance::disabled);
    EXPECT_EQ(read_state(l, Bytes{2, 0x0a}, true), Hindrance::safety_switch);
    EXPECT_EQ(read_state(l, Bytes{2, 0x1a}, false), Hindrance::none) << "OpenFFBoard while an effect plays";
    EXPECT_EQ(read_state(l, Bytes{2, 0x06}, true), Hindrance::power);
    EXPECT_EQ(read_state(l, Bytes{1, 0x06}, true), std::nullopt);
}

TEST(PidLayout, TakesFlagsWhateverTheirRange) {
    // The descriptor `hid_1ffb_desc` of OpenFFBoard states the range 0 to 0 for the flags of one axis.
    const Bytes one_axis = with(test::open_ffboard().descriptor, {0x15, 0, 0x25, 1, 0x75, 1, 0x95, 2, 0x91, 2},
                                {0x15, 0, 0x25, 0, 0x75, 1, 0x95, 2, 0x91, 2});
    const FoundLayout found = found_in(one_axis);
    ASSERT_EQ(found.problem, "");
    EXPECT_EQ(effect_report(found.layout, 3).bytes[13], 4) << "direction enable";
}

TEST(PidLayout, NamesTheFieldThatIsMissing) {
    const Bytes all = test::open_ffboard().descriptor;
    const auto problem = [&](const Bytes& from, const Bytes& to) { return found_in(with(all, from, to)).problem; };
    const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
    EXPECT_TRUE(has(problem({0x09, 0x73, 0xa1}, {0x09, 0x74, 0xa1}), "`set constant force` is missing"));
    EXPECT_TRUE(has(problem({0x09, 0x70, 0x16}, {0x09, 0x71, 0x16}), "`magnitude` is missing"));
    EXPECT_TRUE(has(problem({0x09, 0x77, 0xa1}, {0x09, 0x76, 0xa1}), "`effect operation` is missing"));
    EXPECT_TRUE(has(problem({0x09, 0x50, 0x09}, {0x09, 0x51, 0x09}), "`duration` is missing"));
    EXPECT_TRUE(has(problem({0x09, 0xab, 0xa1}, {0x09, 0xac, 0xa1}), "`create new effect` is missing"));
    EXPECT_TRUE(has(problem({0x09, 0x89, 0xa1}, {0x09, 0x8f, 0xa1}), "`block load` is missing"));
    EXPECT_TRUE(
        has(problem({0x09, 0x95, 0xa1, 0x02, 0x85, 0x0c, 0x09, 0x96}, {0x09, 0x94, 0xa1, 0x02, 0x85, 0x0c, 9, 0x94}),
            "`device control` is missing"));
    EXPECT_TRUE(has(problem({0x09, 0x97}, {0x09, 0x8f}), "`enable actuators of device control` is missing"));
    EXPECT_EQ(problem({0x09, 0x7d, 0xa1}, {0x09, 0x7c, 0xa1}), "") << "the device gain is optional";
    EXPECT_EQ(problem({0x09, 0x90, 0xa1}, {0x09, 0x91, 0xa1}), "") << "so is the freeing of a block";
    EXPECT_EQ(problem({0x09, 0x92, 0xa1}, {0x09, 0x93, 0xa1}), "") << "and the report of its state";
}

TEST(PidLayout, RefusesADescriptorThatLies) {
    const Bytes all = test::open_ffboard().descriptor;
    const auto problem = [&](const Bytes& from, const Bytes& to) { return found_in(with(all, from, to)).problem; };
    const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
    const Bytes magnitude{0x36, 0x01, 0x80, 0x46, 0xff, 0x7f, 0x75, 0x10};
    EXPECT_TRUE(has(problem(magnitude, {0x36, 0x01, 0x80, 0x46, 0xff, 0x7f, 0x75, 0x08}), "`magnitude`"))
        << "16 bits of range in 8 bits";
    EXPECT_TRUE(has(problem({0x09, 0x70, 0x16}, {0x09, 0x70, 0x15, 0x00, 0x36}), "need both signs"));
    const Bytes time{0x66, 0x03, 0x10, 0x55, 0x0d, 0x75, 0x10, 0x95, 0x04};
    EXPECT_TRUE(has(problem(time, {0x66, 0x03, 0x10, 0x55, 0x01, 0x75, 0x10, 0x95, 0x04}), "`duration`"))
        << "a count of 10 s";
    EXPECT_TRUE(has(problem(time, {0x66, 0x13, 0x10, 0x55, 0x0d, 0x75, 0x10, 0x95, 0x04}), "no unit of time"));
    EXPECT_TRUE(has(problem(time, {0x66, 0x03, 0x10, 0x55, 0x09, 0x75, 0x10, 0x95, 0x04}), "cannot be 0.1 s"))
        << "a count of 100 ns";
    EXPECT_TRUE(has(problem(time, {0x66, 0x03, 0x10, 0x55, 0x0d, 0x75, 0x10, 0x95, 0x24}), "64 bytes"));
}

TEST(PidLayout, RefusesADurationThatOutlastsAProgram) {
    const Bytes two_seconds = with(test::open_ffboard().descriptor, {0x46, 0xff, 0x7f, 0x66, 0x03, 0x10, 0x55, 0x0d},
                                   {0x46, 0xff, 0xff, 0x66, 0x03, 0x10, 0x55, 0x00});
    EXPECT_NE(found_in(two_seconds).problem.find("`duration` counts in steps of 2"), std::string::npos)
        << found_in(two_seconds).problem;
}

TEST(PidLayout, CountsADurationInTheUnitOfItsExponent) {
    const Bytes all = test::open_ffboard().descriptor;
    const auto counts = [&](std::uint8_t exponent) {
        const FoundLayout found = found_in(with(all, {0x46, 0xff, 0x7f, 0x66, 0x03, 0x10, 0x55, 0x0d},
                                                {0x46, 0xff, 0x7f, 0x66, 0x03, 0x10, 0x55, exponent}));
        EXPECT_EQ(found.problem, "");
        return found.layout.effect.duration_counts;
    };
    EXPECT_EQ(counts(0x0d), 100);
    EXPECT_EQ(counts(0x0c), 1000);
    EXPECT_EQ(counts(0x0e), 10);
    EXPECT_EQ(counts(0x0f), 1);
    EXPECT_EQ(counts(0x00), 1) << "a second: the shortest that it can";
}

TEST(PidLayout, IgnoresDevicesWithoutForce) {
    const Bytes mouse{0x05, 0x01, 0x09, 0x02, 0xa1, 0x01, 0x09, 0x30, 0x15, 0x81,
                      0x25, 0x7f, 0x75, 0x08, 0x95, 0x01, 0x81, 0x06, 0xc0};
    EXPECT_FALSE(has_force(hid::parse_descriptor(mouse).descriptor));
    EXPECT_TRUE(has_force(hid::parse_descriptor(test::sparse_knob().descriptor).descriptor));
}

}  // namespace
}  // namespace kerf::hid_force
