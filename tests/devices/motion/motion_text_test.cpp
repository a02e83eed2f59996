// SPDX-License-Identifier: Apache-2.0
#include "devices/motion/motion_text.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace kerf::motion {
namespace {

std::string fault_of(const std::string& text) {
    std::string error;
    const auto rows = parse_motion(text, error);
    EXPECT_EQ(rows.has_value(), error.empty());
    return error;
}

TEST(MotionText, HasTheRowsOfItsLines) {
    std::string error;
    const auto rows = parse_motion(
        "# a comment\r\n0,0.1,-0.2,0.3,1,0,0,0,0\r\n\n 0.0015 , 0 , 0 , 1e-3 , 0 , -1 , 0 , 0 , 5\n", error);
    ASSERT_TRUE(rows.has_value()) << error;
    ASSERT_EQ(rows->size(), 2u);
    EXPECT_EQ(length(rows->front().device_from_handle.position - Vec3{0.1, -0.2, 0.3}), 0.0);
    EXPECT_EQ(rows->back().time, 0.0015);
    EXPECT_EQ(rows->back().device_from_handle.rotation.x, -1.0);
    EXPECT_EQ(rows->back().buttons, 5u);
}

TEST(MotionText, NormalisesARotation) {
    std::string error;
    const auto rows = parse_motion("0,0,0,0,0.7074,0.7074,0,0,0\n", error);
    ASSERT_TRUE(rows.has_value()) << error;
    const Quat q = rows->front().device_from_handle.rotation;
    EXPECT_NEAR(q.w * q.w + q.x * q.x, 1.0, 1e-15);
}

TEST(MotionText, IsReadAsItIsWritten) {
    const std::vector<MotionRow> rows{{0.0, {{0.1, 1e-9, -2.0}, {1, 0, 0, 0}}, 0},
                                      {0.0010000000000000009, {{1.0 / 3.0, 0, 0}, {0.6, 0, -0.8, 0}}, 0xffffffffu}};
    const std::string text = text_of(rows, "A notice.");
    EXPECT_TRUE(text.starts_with("# A notice. Columns: time [s], x [m]")) << text;
    std::string error;
    const auto read = parse_motion(text, error);
    ASSERT_TRUE(read.has_value()) << error;
    EXPECT_EQ(text_of(*read, "A notice."), text);
}

TEST(MotionText, NamesLineAndFaultOfABadRow) {
    const std::string good = "# notice\n0,0,0,0,1,0,0,0,0\n";
    const std::pair<const char*, const char*> cases[] = {
        {"0.1,0,0,0,1,0,0,0", "line 3: there are 8 columns, need 9"},
        {"0.1,0,0,0,1,0,0,0,0,0", "line 3: there are 10 columns, need 9"},
        {"x,0,0,0,1,0,0,0,0", "line 3: `time [s]` is `x`, need a number"},
        {"0.1,,0,0,1,0,0,0,0", "line 3: `x [m]` is ``, need a number"},
        {"0.1,0,nan,0,1,0,0,0,0", "line 3: `y [m]` is `nan`, need a number"},
        {"0.1,0,0,1e999,1,0,0,0,0", "line 3: `z [m]` is `1e999`, need a number"},
        {"0.1,0,0,2.5,1,0,0,0,0", "line 3: `z [m]` is 2.5, need -2 to 2"},
        {"-1,0,0,0,1,0,0,0,0", "line 3: `time [s]` is -1, need 0 to 86400"},
        {"0,0,0,0,1,0,0,0,0", "line 3: `time [s]` is 0, need more than 0"},
        {"0.1,0,0,0,1,0.1,0,0,0", "line 3: the quaternion of the rotation has the length 1.004"},
        {"0.1,0,0,0,0,0,0,0,0", "has the length 0, need 1 within 0.001"},
        {"0.1,0,0,0,9,0,0,0,0", "line 3: `rotation w` is 9, need -1.001 to 1.001"},
        {"0.1,0,0,0,1,0,0,0,1.5", "line 3: `buttons` is 1.5, need a whole number"},
        {"0.1,0,0,0,1,0,0,0,4294967296", "line 3: `buttons` is 4294967296, need 0 to 4294967295"},
        {"0.1,0,0,0,1,0,0,0,-1", "line 3: `buttons` is -1"},
        {"0.1,0,\x1b[2J\xff,0,1,0,0,0,0", "`?[2J?`"}};
    for (const auto& [row, cause] : cases)
        EXPECT_NE(fault_of(good + row + "\n").find(cause), std::string::npos) << row << ": " << fault_of(good + row);
    EXPECT_NE(fault_of("").find("has no row"), std::string::npos);
    EXPECT_NE(fault_of("# only a comment\n").find("has no row"), std::string::npos);
    EXPECT_NE(fault_of("0," + std::string(300, '0')).find("line 1: it has 302 bytes, need at most 256"),
              std::string::npos);
}

TEST(Motion, PlaysTheNewestRowNotLater) {
    const auto at_x = [](double time, double x, std::uint32_t buttons) {
        return MotionRow{time, {{x, 0, 0}, {1, 0, 0, 0}}, buttons};
    };
    const Motion motion({at_x(0.002, 2.0, 1), at_x(0.003, 3.0, 2), at_x(0.0055, 5.5, 4)});
    const auto x_at = [&](std::uint64_t ms) { return motion.at(ms).device_from_handle.position.x; };
    EXPECT_EQ(x_at(0), 2.0) << "before the first row";
    EXPECT_EQ(x_at(2), 2.0);
    EXPECT_EQ(x_at(3), 3.0) << "a row counts at its time";
    EXPECT_EQ(x_at(5), 3.0);
    EXPECT_EQ(motion.at(5).buttons, 2u);
    EXPECT_EQ(x_at(6), 5.5);
    EXPECT_EQ(motion.at(6).buttons, 0u) << "after the end no button is pressed";
    EXPECT_EQ(x_at(1u << 30), 5.5);
    EXPECT_EQ(motion.button_count(), 3u);
}

}  // namespace
}  // namespace kerf::motion
