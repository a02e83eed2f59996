// SPDX-License-Identifier: Apache-2.0
#include "core/plugin/plain_text.h"

#include <gtest/gtest.h>

#include <string>

namespace kerf {
namespace {

TEST(PlainText, TakesUtf8AndNothingElse) {
    for (const char* good : {"", "mm", "µm", "…", "\xf0\x9f\xa6\xb4"}) EXPECT_TRUE(is_utf8(good)) << good;
    for (const char* bad : {"caf\xe9", "\xc0\xaf", "\xe0\x80\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xff", "\xc3"})
        EXPECT_FALSE(is_utf8(bad)) << plain(bad);
}

TEST(PlainText, EscapesWhatATerminalWouldObey) {
    EXPECT_EQ(plain("a\x1b[2J\x07"), "a\\x1b[2J\\x07");
    EXPECT_EQ(plain("\xc2\x9b"
                    "2J"),
              "\\xc2\\x9b"
              "2J");  // C1
    EXPECT_EQ(plain("\xe2\x80\xae"
                    "exe"),
              "\\xe2\\x80\\xae"
              "exe");  // turns the direction
    EXPECT_EQ(plain("10 µm\xe9"), "10 µm\\xe9");
    EXPECT_FALSE(is_plain("two\nlines"));
    EXPECT_TRUE(is_plain("κόψιμο"));
}

TEST(PlainText, CutsAtACharacter) {
    const std::string quoted = quoted_plain(std::string(59, 'a') + "µm");
    EXPECT_EQ(quoted, "`" + std::string(59, 'a') + "…`");
}

}  // namespace
}  // namespace kerf
