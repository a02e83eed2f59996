// SPDX-License-Identifier: Apache-2.0
#include "devices/spacemouse/deflections.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "devices/spacemouse/spacemouse.h"

namespace kerf::spacemouse {
namespace {

using Bytes = std::vector<std::uint8_t>;

const Bytes right{1, 0x5e, 0x01, 0, 0, 0, 0}, turned{2, 0x5e, 0x01, 0, 0, 0, 0}, pressed{3, 2, 0};

TEST(Deflections, KeepsAHalfUntilItIsSentAgain) {
    Deflections cap;
    kerf_device_state state{};
    ASSERT_TRUE(cap.take(right, 0.0, state));
    EXPECT_EQ(state.deflection[0], 1.0);
    ASSERT_TRUE(cap.take(turned, 0.01, state));
    ASSERT_TRUE(cap.take(pressed, 0.02, state));
    EXPECT_EQ(state.deflection[0], 1.0);
    EXPECT_EQ(state.deflection[3], 1.0);
    EXPECT_EQ(state.buttons, 2u);
}

TEST(Deflections, CountsAnOldDeflectionAsRest) {
    Deflections cap;
    kerf_device_state state{};
    ASSERT_TRUE(cap.take(right, 0.0, state));
    ASSERT_TRUE(cap.take(turned, 0.05, state));
    ASSERT_TRUE(cap.take(pressed, 0.09, state));
    EXPECT_FALSE(cap.expire(0.1, state));
    EXPECT_TRUE(cap.expire(0.101, state));
    EXPECT_EQ(state.deflection[0], 0.0);
    EXPECT_EQ(state.deflection[3], 1.0) << "the other half is younger";
    EXPECT_TRUE(cap.expire(0.151, state));
    EXPECT_EQ(state.deflection[3], 0.0);
    EXPECT_EQ(state.buttons, 2u) << "a held button sends nothing";
    EXPECT_FALSE(cap.expire(10.0, state)) << "nothing is left to expire";
}

TEST(Deflections, LeavesTheStateAfterGarbage) {
    Deflections cap;
    kerf_device_state state{};
    ASSERT_TRUE(cap.take(right, 0.0, state));
    EXPECT_FALSE(cap.take(Bytes{1, 2, 3}, 0.01, state));
    EXPECT_EQ(state.deflection[0], 1.0);
}

TEST(SpaceMouse, IsAMultiAxisControllerOfItsMakers) {
    const auto is_one = model().is_one;
    EXPECT_TRUE(is_one({.path = "", .vendor = 0x046d, .product = 0xc626, .usage_page = 1, .usage = 8}));
    EXPECT_TRUE(is_one({.path = "", .vendor = 0x256f, .product = 0xc635, .usage_page = 1, .usage = 8}));
    EXPECT_FALSE(is_one({.path = "", .vendor = 0x046d, .product = 0xc077, .usage_page = 1, .usage = 2})) << "a mouse";
    EXPECT_FALSE(is_one({.path = "", .vendor = 0x1209, .product = 0xc626, .usage_page = 1, .usage = 8}));
    EXPECT_EQ(model().facts({.path = "", .product = 0xc626}).button_count, 2u);
    EXPECT_EQ(model().facts({.path = "", .product = 0xc62b}).button_count, 27u);
}

}  // namespace
}  // namespace kerf::spacemouse
