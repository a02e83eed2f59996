// SPDX-License-Identifier: Apache-2.0
#include "text/palette.h"

#include <gtest/gtest.h>

#include <string>

namespace kerf::text {
namespace {

TEST(Palette, WritesColoursAsHex) {
    EXPECT_EQ((Colour{0x0a, 0xf0, 0xff}.hex()), "#0af0ff");
    EXPECT_EQ(palette::cortical.hex(), "#e8dcc4");
}

TEST(Palette, FindsTissuesByName) {
    EXPECT_EQ(tissue_colour("cancellous", 0), palette::cancellous);
    EXPECT_EQ(tissue_colour("cancellous", 5), palette::cancellous) << "wherever it is listed";
    EXPECT_EQ(tissue_colour("root", 1), palette::dentine);
    EXPECT_NE(tissue_colour("callus", 0), tissue_colour("callus", 1)) << "unknown names differ by position";
    EXPECT_EQ(tissue_colour("callus", 1), tissue_colour("callus", 7)) << "six colours in turn";
}

}  // namespace
}  // namespace kerf::text
