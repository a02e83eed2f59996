// SPDX-License-Identifier: Apache-2.0
#include "session/clock_picture.h"

#include <gtest/gtest.h>

#include <string>

#include "session/recorder.h"

namespace kerf::session {
namespace {

ClockRow clock_of_a_run() {
    ClockRow clock;
    clock.period = 1e-3;
    clock.ticks = 111;
    clock.late_ticks = 1;
    clock.histogram = {{1e-6, 100, 0}, {1e-5, 10, 110}, {1e-4, 0, 1}, {1e-2, 1, 0}};
    clock.late_causes = {{"own computing", 0}, {"core taken by another thread", 1}};
    clock.slowest = {{70, 5e-3, 5.1e-3, 5e-5, "core taken by another thread", "motion <and> force", 4e-5, 3}};
    return clock;
}

TEST(ClockPicture, ShowsTheSlowestTicksWithTheirCauses) {
    RunSummary summary;
    summary.procedure = "pedicle-awl";
    const std::string svg = clock_svg(summary, clock_of_a_run());
    EXPECT_NE(svg.find("1 late: 1 core taken by another thread"), std::string::npos) << svg;
    EXPECT_NE(svg.find("motion &lt;and&gt; force 0.040 ms"), std::string::npos) << svg;
    EXPECT_NE(svg.find("5.100 ms"), std::string::npos);
    EXPECT_EQ(svg.find("own computing"), std::string::npos) << "no tick was late by its own computing";
    EXPECT_NE(svg.find(notice_line), std::string::npos);
    EXPECT_TRUE(svg.starts_with("<svg") && svg.ends_with("</svg>\n"));
}

// The axis reaches to the last class with a tick, 10 ms, and no farther.
TEST(ClockPicture, HasAnAxisAsLongAsItsTicks) {
    const std::string svg = clock_svg({}, clock_of_a_run());
    EXPECT_NE(svg.find(">10 ms<"), std::string::npos);
    EXPECT_EQ(svg.find(">100 ms<"), std::string::npos);
}

TEST(ClockPicture, DrawsARunWithoutTicks) {
    const std::string svg = clock_svg({}, {});
    EXPECT_EQ(svg.find("nan"), std::string::npos) << svg;
    EXPECT_EQ(svg.find("inf"), std::string::npos) << svg;
}

}  // namespace
}  // namespace kerf::session
