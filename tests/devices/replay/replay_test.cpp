// SPDX-License-Identifier: Apache-2.0
#include "devices/replay/replay.h"

#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "core/haptics/watch/watch.h"
#include "devices/motion/motion_text.h"
#include "tests/devices/motion/opened_driver.h"
#include "tests/support/temporary_folder.h"

namespace kerf::replay {
namespace {

using motion::MotionRow;
using test::open_with_motion;
using test::pushing;

/// One row each millisecond; the handle rises, turns about z and presses buttons in turn.
std::vector<MotionRow> rising() {
    std::vector<MotionRow> rows;
    for (int i = 0; i < 50; ++i)
        rows.push_back({i / 1000.0,
                        {{0.0, 1e-3 * i, 0.0}, quat_from_rotation_vector({0.0, 0.0, 0.01 * i})},
                        static_cast<std::uint32_t>(i % 4)});
    return rows;
}

class ReplayedMotion : public testing::Test {
protected:
    std::string file_with(const std::string& text) {
        const std::string file = folder_ / "motion.csv";
        std::ofstream(file) << text;
        return file;
    }
    test::TemporaryFolder folder_;
};

void expect_row(const kerf_device_state& state, const MotionRow& row) {
    EXPECT_EQ(state.flags, std::uint32_t{KERF_DEVICE_VALID});
    EXPECT_EQ(length(state.device_from_handle.position - row.device_from_handle.position), 0.0);
    EXPECT_EQ(state.device_from_handle.rotation.z, row.device_from_handle.rotation.z);
    EXPECT_EQ(state.buttons, row.buttons);
}

TEST_F(ReplayedMotion, IsThatOfTheFile) {
    const std::vector<MotionRow> rows = rising();
    const auto device = open_with_motion<Replay>(file_with(motion::text_of(rows, "")));
    EXPECT_EQ(device->facts().button_count, 2u);
    for (int i = 0; i < 3; ++i) expect_row(device->read(), rows.front());
    device->write(pushing({1, 2, 3}));
    for (std::size_t i = 1; i < rows.size(); ++i) {
        expect_row(device->read(), rows[i]);
        device->write(pushing({9, 0, 0}));
    }
    MotionRow last = rows.back();
    last.buttons = 0;
    for (int i = 0; i < 3; ++i) expect_row(device->read(), last);
}

TEST_F(ReplayedMotion, WaitsForTheFirstTick) {
    const std::vector<MotionRow> rows = rising();
    const auto device = open_with_motion<Replay>(file_with(motion::text_of(rows, "")));
    kerf_device_command before = pushing();
    before.flags = 0;
    for (int i = 0; i < 20; ++i) {
        device->write(before);
        expect_row(device->read(), rows.front());
    }
    device->write(pushing());
    expect_row(device->read(), rows[1]);
}

TEST_F(ReplayedMotion, AllocatesAndLocksNothingInATick) {
    if (!conformance::can_watch()) GTEST_SKIP() << "a sanitizer is built in";
    const auto device = open_with_motion<Replay>(file_with(motion::text_of(rising(), "")));
    conformance::start_watching();
    for (int i = 0; i < 100; ++i) {
        static_cast<void>(device->read());
        device->write(pushing());
    }
    const conformance::Watched seen = conformance::stop_watching();
    for (const char* function : seen.function) EXPECT_EQ(function, nullptr) << function;
}

TEST_F(ReplayedMotion, NeedsAMotion) {
    EXPECT_NE(test::refusal_of<Replay>("").find("Write `motion: FILE`"), std::string::npos);
    EXPECT_NE(test::refusal_of<Replay>(folder_ / "none.csv").find("is no file"), std::string::npos);
    EXPECT_NE(test::refusal_of<Replay>(folder_.path()).find("is no file"), std::string::npos);
    EXPECT_NE(test::refusal_of<Replay>(file_with("0,0\n")).find("motion.csv, line 1: there are 2 columns"),
              std::string::npos);
    EXPECT_NE(test::refusal_of<Replay>(file_with("0,0,0,0,1,0,0,0,0\n"), "left").find("its id is `left`"),
              std::string::npos);
}

}  // namespace
}  // namespace kerf::replay
