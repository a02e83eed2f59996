// SPDX-License-Identifier: Apache-2.0
#include "text/printable.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <utility>

#include "documents/yaml/document.h"

namespace kerf::text {
namespace {

TEST(Printable, KeepsLettersOfEveryScript) {
    for (const char* text : {"femur", "Hüfte, 5 µm", "大腿骨", "\xf0\x9f\xa6\xb4", ""})
        EXPECT_EQ(printable(text), text);
}

TEST(Printable, EscapesWhatATerminalObeysOrAReaderMisses) {
    const std::pair<std::string_view, const char*> texts[]{
        {"a\x1b[2Jb", "a\\x1b[2Jb"},  // clears a screen
        {"\x07\x08\t\r\n", "\\x07\\x08\\x09\\x0d\\x0a"},
        {"\x7f", "\\x7f"},            // delete
        {"\xc2\x9b", "\\x9b"},        // the same as ESC [, as one character
        {"\xe2\x80\xae", "\\u202e"},  // turns the direction of writing
        {"\xe2\x80\xa8", "\\u2028"},  // ends a line
        {"\xe2\x80\x8b", "\\u200b"},  // has no width
        {"\xef\xbb\xbf", "\\ufeff"},  // a byte order mark
        {"\xf3\xa0\x81\x81", "\\U000e0041"},
        {std::string_view("a\0b", 3), "a\\x00b"},
    };
    for (const auto& [text, shown] : texts) EXPECT_EQ(printable(text), shown);
}

TEST(Printable, EscapesBytesThatAreNoUtf8) {
    for (const auto& [text, shown] : {std::pair{"\xff", "\\xff"},
                                      {"\xc3", "\\xc3"},                    // cut off
                                      {"\xc0\xaf", "\\xc0\\xaf"},           // too long a form of `/`
                                      {"\xed\xa0\x80", "\\xed\\xa0\\x80"},  // half a surrogate pair
                                      {"\xc3(", "\\xc3("}})
        EXPECT_EQ(printable(text), shown);
}

TEST(Excerpt, CutsAtACharacterAndCountsTheRest) {
    EXPECT_EQ(excerpt("abc", 3), "abc");
    EXPECT_EQ(excerpt("äöü", 2), "äö… (1 more character)");
    EXPECT_EQ(excerpt(std::string(100, 'x'), 60), std::string(60, 'x') + "… (40 more characters)");
    EXPECT_EQ(excerpt("\x1b[2J", 2), "\\x1b[… (2 more characters)");
}

TEST(YamlQuoted, ReadsBackAsTheSameText) {
    for (const std::string text :
         {"entry \"left\" \\ back", "a: b # c", "line, middle", "tab\there", "", " blanks ", "true", "12", "- 3"}) {
        Diagnostics diagnostics;
        const auto document =
            documents::parse_document("a.yaml", "[" + yaml_quoted(text) + ", " + yaml_word(text) + "]\n")
                .take(diagnostics);
        ASSERT_TRUE(document) << to_text(diagnostics);
        EXPECT_EQ(document->root.children.at(0).text, text);
        EXPECT_EQ(document->root.children.at(1).text, text);
    }
}

TEST(YamlWord, QuotesOnlyWhatNeedsIt) {
    EXPECT_EQ(yaml_word("left_femur-2"), "left_femur-2");
    for (const char* text : {"", "2", "No", "null", "a b", "a,b", "Hüfte"})
        EXPECT_EQ(yaml_word(text), yaml_quoted(text)) << text;
}

}  // namespace
}  // namespace kerf::text
