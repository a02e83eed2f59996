// SPDX-License-Identifier: Apache-2.0
#include "core/session/content_hash.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string_view>

namespace kerf {
namespace {

std::uint64_t hash_of(const TickRow& row) {
    ContentHash hash;
    add_tick(hash, row);
    return hash.value();
}

TEST(ContentHash, GivesThePublishedValuesOfFnv1a) {
    EXPECT_EQ(hash_of_text(""), 0xcbf29ce484222325u);
    EXPECT_EQ(hash_of_text("a"), 0xaf63dc4c8601ec8cu);
    EXPECT_EQ(hash_of_text("foobar"), 0x85944171f73967e8u);
}

TEST(ContentHash, TakesTheLeastSignificantByteFirst) {
    ContentHash number;
    number.add(std::uint32_t{0x64636261});
    EXPECT_EQ(number.value(), hash_of_text("abcd"));
}

TEST(ContentHash, TakesANumberByItsBits) {
    ContentHash one;  // 1.0 is 3ff0000000000000
    one.add(1.0);
    EXPECT_EQ(one.value(), hash_of_text(std::string_view("\0\0\0\0\0\0\xf0\x3f", 8)));
}

TEST(ContentHash, AllNotANumbersCountAsOne) {
    ContentHash plus, minus;
    plus.add(std::numeric_limits<double>::quiet_NaN());
    minus.add(-std::numeric_limits<double>::quiet_NaN());
    EXPECT_EQ(plus.value(), minus.value());
}

TEST(ContentHash, SeesInputPoseAndWrenchOfATick) {
    const TickRow row;
    TickRow other_input, other_pose, other_wrench;
    other_input.device_from_handle.position.x = 1e-300;
    other_pose.world_from_tool.rotation.w = 1.0;
    other_wrench.modelled[5] = 1e-9;

    EXPECT_NE(hash_of(other_input), hash_of(row));
    EXPECT_NE(hash_of(other_pose), hash_of(row));
    EXPECT_NE(hash_of(other_wrench), hash_of(row));
}

TEST(ContentHash, DoesNotSeeWhatTheDeviceWasSent) {
    TickRow row;
    row.commanded[0] = 3.0;
    EXPECT_EQ(hash_of(row), hash_of(TickRow{}));
}

TEST(ContentHash, IsWrittenAsSixteenDigits) { EXPECT_EQ(hex16(0x0123456789abcdefu), "0123456789abcdef"); }

}  // namespace
}  // namespace kerf
