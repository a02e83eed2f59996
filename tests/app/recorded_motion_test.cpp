// SPDX-License-Identifier: Apache-2.0
// `kerf devices test --record`, and a run that the recorded motion leads.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "devices/motion/motion.h"
#include "devices/motion/motion_text.h"
#include "devices/simulated_hand/hand_device.h"
#include "kerf/device_driver.hpp"
#include "session/read_session.h"
#include "session/recorder.h"
#include "tests/devices/motion/opened_driver.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

namespace kerf::app {
namespace {

/// Aside by 20 mm and back within 0.3 s, with a button in between.
std::string aside_and_back() {
    std::vector<motion::MotionRow> rows;
    for (int ms = 0; ms <= 300; ++ms) {
        const double aside = 0.02 * (1.0 - std::abs(ms - 150) / 150.0);
        rows.push_back({ms / 1000.0, {{aside, 0, 0}, {1, 0, 0, 0}}, ms > 100 && ms < 200 ? 1u : 0u});
    }
    return motion::text_of(rows, "A motion of a test.");
}

class RecordedMotion : public testing::Test {
protected:
    void SetUp() override {
        std::ofstream(led_) << aside_and_back();
        std::ofstream(station_) << "apiVersion: kerf/v1\nkind: Station\ndevices:\n"
                                << "  - {device: simulated_hand, motion: " << led_ << "}\n"
                                << "  - {device: replay, motion: " << recorded_ << "}\n";
    }
    [[nodiscard]] test::Ended kerf(const std::string& arguments) const {
        return test::kerf(arguments, "KERF_STATION=" + station_);
    }
    [[nodiscard]] test::Ended record() const {
        return kerf("devices test simulated_hand --record " + recorded_ + " --for '0.6 s'");
    }
    [[nodiscard]] std::vector<motion::MotionRow> recorded_rows() const {
        std::string error;
        const auto rows = motion::parse_motion(test::contents_of(recorded_), error);
        EXPECT_TRUE(rows) << error;
        return rows.value_or(std::vector<motion::MotionRow>{});
    }

    test::TemporaryFolder folder_;
    std::string station_ = folder_ / "station.yaml", led_ = folder_ / "led.csv", recorded_ = folder_ / "recorded.csv";
};

/// Of a force-free arm, tick by tick, whatever the clock.
TEST_F(RecordedMotion, IsThatOfTheHandle) {
    const test::Ended ended = record();
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_NE(ended.out.find("motion: " + recorded_), std::string::npos) << ended.out;
    EXPECT_NE(test::contents_of(recorded_).find(session::notice_line), std::string::npos);
    const std::vector<motion::MotionRow> rows = recorded_rows();
    ASSERT_GE(rows.size(), 2u);
    EXPECT_EQ(rows.front().time, 0.0);
    const auto device = test::open_with_motion<simulated_hand::HandDevice>(led_);
    for (const motion::MotionRow& row : rows) {
        const kerf_device_state state = device->read();
        EXPECT_EQ(length(row.device_from_handle.position - state.device_from_handle.position), 0.0) << row.time;
        EXPECT_EQ(row.buttons, state.buttons) << row.time;
        device->write(test::pushing());
    }
}

TEST_F(RecordedMotion, LeadsARun) {
    ASSERT_EQ(record().exit_code, 0);
    const motion::Motion motion(recorded_rows());
    const test::Ended ended =
        kerf("run " KERF_SOURCE_DIR "/procedures/pedicle-awl.yaml --device replay --set 'time_limit=1 s' --out " +
             (folder_ / "run"));
    EXPECT_EQ(ended.exit_code, 1) << "an operation of a second does not pass: " << ended.err;
    std::string error;
    const auto inputs = session::read_session(folder_ / "run/session.db", error);
    ASSERT_TRUE(inputs) << error;
    EXPECT_EQ(inputs->device, "replay recorded handle");
    const std::vector<Pose>& poses = inputs->device_from_handle;
    ASSERT_GE(poses.size(), 400u);
    for (std::size_t tick = 0; tick < poses.size(); ++tick) {
        const Vec3 moved = motion.at(tick).device_from_handle.position - motion.at(0).device_from_handle.position;
        EXPECT_NEAR(length(poses[tick].position - poses[0].position), length(moved), 1e-12) << tick;
    }
}

TEST_F(RecordedMotion, NeedsATimeAndATest) {
    EXPECT_NE(kerf("devices test simulated_hand --for 5").err.find("`--for`"), std::string::npos);
    EXPECT_EQ(kerf("devices test simulated_hand --for '2 h'").exit_code, 2);
    EXPECT_NE(kerf("devices --record " + recorded_).err.find("only `kerf devices test`"), std::string::npos);
    const test::Ended ended = kerf("devices test simulated_hand --for '0.1 s' --record " + (folder_ / "none/a.csv"));
    EXPECT_EQ(ended.exit_code, 2) << "the folder does not exist";
}

}  // namespace
}  // namespace kerf::app
