// SPDX-License-Identifier: Apache-2.0
#include "text/printable_lines.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace kerf::text {
namespace {

TEST(PrintableLines, KeepsLineBreaksAndTabsOnly) {
    EXPECT_EQ(printable_lines("a\n\tb\r\nc\rd\033[2J\n"), "a\n\tb\r\nc\\x0dd\\x1b[2J\n");
    EXPECT_EQ(printable_lines("\u009b2J\u202e\x7f\r"), "\\x9b2J\\u202e\\x7f\\x0d");
    EXPECT_EQ(printable_lines(std::string("a\0b\x9b", 4)), "a\\x00b\\x9b");
    EXPECT_EQ(printable_lines("pédicule: 3 mm ± 0.1, 骨\n"), "pédicule: 3 mm ± 0.1, 骨\n");
}

TEST(PrintableJson, ReadsBackToTheSameText) {
    const std::string text = "a\033\x7f\u009b\u202e\U000e0001é骨\n\"\\";
    const std::string json = printable_json(nlohmann::json{{"key", text}}.dump(2));
    EXPECT_EQ(json, printable_lines(json));
    EXPECT_EQ(nlohmann::json::parse(json)["key"], text);
}

}  // namespace
}  // namespace kerf::text
