// SPDX-License-Identifier: Apache-2.0
#include "devices/spacemouse/report.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace kerf::spacemouse {
namespace {

using Bytes = std::vector<std::uint8_t>;

void expect_near(const std::optional<Vec3>& got, Vec3 expected) {
    ASSERT_TRUE(got);
    EXPECT_NEAR(length(*got - expected), 0.0, 1e-12);
}

// Captured from a SpaceNavigator: github.com/AndunHH/spacemouse, SpaceNavigator.md.
TEST(SpaceMouseReport, ReadsTheCaptureOfASpaceNavigator) {
    expect_near(decode(Bytes{0x01, 0, 0, 0, 0, 0, 0})->translation, {});
    // Its right side is pressed down: against a turn about the axis that leads towards the user.
    const auto tilted = decode(Bytes{0x02, 0x00, 0x00, 0xe2, 0xff, 0x00, 0x00});
    ASSERT_TRUE(tilted);
    EXPECT_FALSE(tilted->translation);
    expect_near(tilted->rotation, {0, 0, -30.0 / 350.0});
    EXPECT_EQ(decode(Bytes{0x03, 0x01, 0x00})->buttons, 1u);
    EXPECT_EQ(decode(Bytes{0x03, 0x03, 0x00})->buttons, 3u);
    EXPECT_EQ(decode(Bytes{0x03, 0x00, 0x00})->buttons, 0u);
}

// Captured from a SpaceMouse Compact: github.com/CloudCompare/CloudCompare, pull request 2339.
TEST(SpaceMouseReport, ReadsTheCaptureOfASpaceMouseCompact) {
    expect_near(decode(Bytes{0x02, 0x1d, 0x00, 0x00, 0x00, 0x1b, 0x00})->rotation, {29.0 / 350.0, -27.0 / 350.0, 0});
    expect_near(decode(Bytes{0x01, 0x0d, 0x00, 0x00, 0x00, 0x25, 0x01})->translation,
                {13.0 / 350.0, -293.0 / 350.0, 0});
}

// Captured from a SpaceMouse Wireless whose cap is pushed down: github.com/nytamin/spacemouse, issue 1.
TEST(SpaceMouseReport, ReadsBothHalvesOfALongReport) {
    const auto pushed = decode(Bytes{0x01, 0, 0, 0, 0, 0x07, 0, 0, 0, 0, 0, 0, 0});
    ASSERT_TRUE(pushed);
    expect_near(pushed->translation, {0, -7.0 / 350.0, 0});
    expect_near(pushed->rotation, {});
    const auto each = decode(Bytes{0x01, 10, 0, 20, 0, 30, 0, 40, 0, 50, 0, 60, 0});
    ASSERT_TRUE(each);
    expect_near(each->translation, Vec3{10, -30, 20} / 350.0);
    expect_near(each->rotation, Vec3{40, -60, 50} / 350.0);
}

// The captures above tell the fields apart: none reads the same with two of its fields exchanged.
TEST(SpaceMouseReport, ReadsExchangedFieldsDifferently) {
    const Bytes captured{0x01, 0x0d, 0x00, 0x00, 0x00, 0x25, 0x01};
    for (const std::size_t a : {1u, 3u, 5u})
        for (const std::size_t b : {1u, 3u, 5u}) {
            if (a == b) continue;
            Bytes moved = captured;
            std::swap(moved[a], moved[b]);
            std::swap(moved[a + 1], moved[b + 1]);
            EXPECT_GT(length(*decode(moved)->translation - *decode(captured)->translation), 1e-3);
        }
}

TEST(SpaceMouseReport, ClampsValuesBeyondTheRange) {
    expect_near(decode(Bytes{0x01, 0xff, 0x7f, 0x00, 0x80, 0x90, 0x01})->translation, {1, -1, -1});
}

TEST(SpaceMouseReport, IgnoresTheBattery) {
    const auto battery = decode(Bytes{0x17, 0x64});
    ASSERT_TRUE(battery);
    EXPECT_FALSE(battery->translation || battery->rotation || battery->buttons);
}

TEST(SpaceMouseReport, RefusesOtherBytes) {
    for (const Bytes& bytes : {Bytes{}, Bytes{1}, Bytes{3}, Bytes{1, 0, 0, 0, 0, 0}, Bytes{1, 0, 0, 0, 0, 0, 0, 0},
                               Bytes{2, 0, 0, 0}, Bytes{2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
                               Bytes{3, 0, 0, 0, 0, 0, 0, 0}, Bytes{0, 1, 2, 3, 4, 5, 6}, Bytes(64, 1)})
        EXPECT_FALSE(decode(bytes)) << bytes.size();
}

}  // namespace
}  // namespace kerf::spacemouse
