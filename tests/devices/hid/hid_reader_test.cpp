// SPDX-License-Identifier: Apache-2.0
// The reader of a SpaceMouse over a scripted transport, on a virtual clock.
#include "devices/hid/hid_reader.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>

#include "devices/spacemouse/spacemouse.h"
#include "tests/devices/hid/scripted_transport.h"

namespace kerf::hid {
namespace {

using test::HidTable;
using test::ReportBytes;
using test::ScriptedTransport;
using test::space_navigator;

constexpr std::uint32_t valid = KERF_DEVICE_VALID;

ReportBytes push_right(int counts) {
    return {1, static_cast<std::uint8_t>(counts & 0xff), static_cast<std::uint8_t>(counts >> 8), 0, 0, 0, 0};
}

/// A SpaceNavigator that is open.
struct Rig {
    HidTable table;
    std::unique_ptr<HidReader> reader;

    explicit Rig(const std::string& serial = "") {
        table.plug_in(space_navigator("/dev/hidraw3", serial));
        const HidModel model = spacemouse::model();
        reader = std::make_unique<HidReader>(std::make_unique<ScriptedTransport>(table), model,
                                             devices_of(model, table.entries).front());
        EXPECT_EQ(reader->open(), "");
    }
    bool step() { return reader->step(table.now); }
    /// Steps without reports; a lost device is searched in steps of 20 ms.
    void wait(double seconds) {
        for (const double end = table.now + seconds; table.now < end;) {
            const double before = table.now;
            static_cast<void>(step());
            if (table.now == before) table.now += 20e-3;
        }
    }
    [[nodiscard]] double right() const { return reader->state().deflection[0]; }
};

TEST(HidReader, IsValidAtRestWithoutAReport) {
    Rig rig;
    EXPECT_EQ(rig.reader->state().flags, valid);
    rig.wait(60.0);
    EXPECT_EQ(rig.reader->state().flags, valid) << "a cap at rest is silent";
    EXPECT_EQ(rig.table.searches, 0);
}

TEST(HidReader, TakesTheNewestOfAStaleQueue) {
    Rig rig;
    for (int i = 1; i <= 63; ++i) rig.table.queue.push_back(push_right(i));
    EXPECT_TRUE(rig.step());
    EXPECT_EQ(rig.right(), 63.0 / 350.0);
    EXPECT_EQ(rig.reader->state().reports, 63u);
    EXPECT_TRUE(rig.table.queue.empty());
}

TEST(HidReader, CountsGarbageAndGoesOn) {
    Rig rig;
    rig.table.queue = {{9, 9, 9}, {1, 2}, ReportBytes(200, 1), push_right(350), {0xff}};
    EXPECT_TRUE(rig.step());
    EXPECT_EQ(rig.right(), 1.0);
    EXPECT_EQ(rig.reader->ignored(), 4u);
    EXPECT_EQ(rig.reader->state().reports, 1u);
    rig.table.queue = {{1}};
    EXPECT_FALSE(rig.step()) << "nothing has changed";
}

TEST(HidReader, FloodDelaysNoValue) {
    Rig rig;
    for (int i = 0; i < 100'000; ++i) rig.table.queue.push_back({9, 9});
    rig.table.queue.push_front(push_right(350));
    EXPECT_TRUE(rig.step());
    EXPECT_FALSE(rig.table.queue.empty()) << "a step takes a limited number";
    EXPECT_EQ(rig.right(), 1.0);
}

TEST(HidReader, RestsAfterADeflectionWithoutItsEnd) {
    Rig rig;
    rig.table.queue = {push_right(350)};
    EXPECT_TRUE(rig.step());
    rig.wait(0.09);
    EXPECT_EQ(rig.right(), 1.0);
    rig.wait(0.02);
    EXPECT_EQ(rig.right(), 0.0);
}

TEST(HidReader, IsLostWhereverItIsUnplugged) {
    // Before the first report, after half a pair, and after a button
    const std::vector<std::vector<ReportBytes>> scripts{
        {}, {push_right(350)}, {push_right(350), {2, 0x5e, 1, 0, 0, 0, 0}}, {push_right(350), {3, 1, 0}}};
    for (const auto& script : scripts) {
        Rig rig;
        for (const ReportBytes& report : script) rig.table.queue.push_back(report);
        static_cast<void>(rig.step());
        rig.table.unplug();
        EXPECT_TRUE(rig.step());
        EXPECT_FALSE(rig.reader->is_open());
        EXPECT_EQ(rig.reader->state().flags, 0u);
        EXPECT_EQ(rig.reader->state().buttons, 0u);
        for (const double d : rig.reader->state().deflection) EXPECT_EQ(d, 0.0);
        EXPECT_EQ(rig.reader->state().reports, script.size());
    }
}

TEST(HidReader, FindsItsDeviceAgainOnAnotherNode) {
    Rig rig("A1");
    rig.table.unplug();
    static_cast<void>(rig.step());
    rig.wait(3.0);
    EXPECT_GE(rig.table.searches, 2);
    EXPECT_LE(rig.table.searches, 3) << "once a second";
    rig.table.plug_in(space_navigator("/dev/hidraw5", "B2"));
    rig.wait(1.1);
    EXPECT_FALSE(rig.reader->is_open()) << "it is another one";
    rig.table.plug_in(space_navigator("/dev/hidraw7", "A1"));
    rig.wait(1.1);
    EXPECT_EQ(rig.reader->state().flags, valid);
    rig.table.queue = {push_right(175)};
    EXPECT_TRUE(rig.step());
    EXPECT_EQ(rig.right(), 0.5);
}

TEST(HidReader, TriesAgainWhileTheNodeIsRefused) {
    Rig rig;
    rig.table.unplug();
    static_cast<void>(rig.step());
    rig.table.plug_in(space_navigator("/dev/hidraw3"));
    rig.table.refusal = "permission denied";  // the rules have not been applied yet
    rig.wait(2.5);
    EXPECT_FALSE(rig.reader->is_open());
    rig.table.refusal.clear();
    rig.wait(1.1);
    EXPECT_TRUE(rig.reader->is_open());
}

}  // namespace
}  // namespace kerf::hid
