// SPDX-License-Identifier: Apache-2.0
#include "documents/yaml/document.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>

#include "tests/documents/marked_text.h"
#include "text/codes.h"

namespace kerf::documents {
namespace {

void expect_refused(text::Code code, const std::string& marked_text) {
    SCOPED_TRACE(marked_text);
    const MarkedText marked(marked_text);
    text::Diagnostics diagnostics;
    parse_document("file.yaml", marked.text).take(diagnostics);
    expect_only(code, marked, diagnostics);
}

TEST(Document, KeepsTheOrderAndThePlaceOfEverything) {
    text::Diagnostics diagnostics;
    const auto document = parse_document("file.yaml", "b: 1\na:\n  - \"x y\"\n  - {k: v}\n").take(diagnostics);

    ASSERT_TRUE(document) << to_text(diagnostics);
    ASSERT_EQ(document->root.children.size(), 2u);
    const Node& list = document->root.children[1];
    EXPECT_EQ(document->root.children[0].key, "b");
    EXPECT_EQ(document->place(list.key_span).line, 2);
    EXPECT_EQ(list.children[0].text, "x y");
    EXPECT_EQ(document->place(list.children[0].span).column, 5);
    EXPECT_EQ(document->place(list.children[0].span).length, 5);
    EXPECT_EQ(document->place(list.children[1].find("k")->span).line, 4);
    EXPECT_EQ(document->place(list.children[1].find("k")->span).column, 9);
}

TEST(Document, CountsCharactersNotBytes) {
    text::Diagnostics diagnostics;
    const auto document = parse_document("file.yaml", "{é: ü, a: ß}\n").take(diagnostics);
    ASSERT_TRUE(document) << to_text(diagnostics);
    EXPECT_EQ(document->place(document->root.find("a")->span).column, 11);
    EXPECT_EQ(document->place(document->root.find("a")->span).length, 1);
}

TEST(Document, WindowsLineEndsAndAByteOrderMarkShiftNothing) {
    text::Diagnostics diagnostics;
    const auto document = parse_document("file.yaml", "\xEF\xBB\xBF"
                                                      "a: 1\r\nb: 2\r\n")
                              .take(diagnostics);
    ASSERT_TRUE(document) << to_text(diagnostics);
    EXPECT_EQ(document->place(document->root.find("a")->span).column, 4);
    EXPECT_EQ(document->place(document->root.find("b")->span).line, 2);
    EXPECT_EQ(document->source_line(document->root.find("b")->span), "b: 2");
}

TEST(Document, GuessesNoTypes) {
    text::Diagnostics diagnostics;
    const auto document = parse_document("file.yaml", "yes: no\n1.0: 1e3\n").take(diagnostics);
    ASSERT_TRUE(document);
    EXPECT_EQ(document->root.find("yes")->text, "no");
    EXPECT_EQ(document->root.find("1.0")->text, "1e3");
}

TEST(Document, AnAbsentValueStandsAtItsKey) {
    text::Diagnostics diagnostics;
    const auto document = parse_document("file.yaml", "a:\n\n\nb: 1\n").take(diagnostics);
    ASSERT_TRUE(document);
    EXPECT_EQ(document->place(document->root.find("a")->span).line, 1);
}

TEST(Document, RefusesAKeyThatStandsTwice) { expect_refused(text::Code::duplicate_key, "a: 1\nb: 2\n«a»: 3\n"); }
TEST(Document, RefusesAnAnchor) { expect_refused(text::Code::anchor_or_alias, "a: «&x» 1\n"); }
TEST(Document, RefusesATagOnAValue) { expect_refused(text::Code::tag, "a: «!»!str 1\n"); }
TEST(Document, RefusesATagOnAList) { expect_refused(text::Code::tag, "a: «!»set [1]\n"); }
TEST(Document, RefusesASecondDocument) { expect_refused(text::Code::several_documents, "a: 1\n«-»--\nb: 1\n"); }
TEST(Document, RefusesAListAsAKey) { expect_refused(text::Code::key_not_text, "«[»a]: 1\nb: 2\n"); }
/// The one error of a text that is not YAML.
std::string said_of(const std::string& text) {
    text::Diagnostics diagnostics;
    parse_document("file.yaml", text).take(diagnostics);
    EXPECT_EQ(diagnostics.size(), 1u) << to_text(diagnostics);
    return diagnostics.empty() ? "" : diagnostics[0].message;
}

TEST(Document, ADecimalCommaInAMapIsOneErrorWithThePointToWrite) {
    expect_refused(text::Code::not_a_number, "a: {b: «3,2 mm», c: 1}\n");
    expect_refused(text::Code::not_a_number, "a: {b: «-5,5 mm»}\n");
    expect_refused(text::Code::not_three_numbers, "a: {b: «44,35»,28 mm, c: 1}\n");
    text::Diagnostics diagnostics;
    parse_document("file.yaml", "a: {b: 3,2 mm}\n").take(diagnostics);
    ASSERT_EQ(diagnostics.size(), 1u);
    EXPECT_EQ(diagnostics[0].write, "3.2 mm");
}

TEST(Document, ACommaBetweenEntriesIsNoDecimalComma) {
    text::Diagnostics diagnostics;
    const auto document = parse_document("file.yaml", "{a: 3, 2b: 1, c: [1,2]}\n").take(diagnostics);
    ASSERT_TRUE(document) << to_text(diagnostics);
    EXPECT_EQ(document->root.children.size(), 3u);
}

TEST(Document, WhatTheFileEndsInTheMiddleOfIsPointedAt) {
    for (const char* text :
         {"a: 1\nb: «{»c: 1", "a: [1]\nb: «[»1, 2", "a: 1\nb: «\"»x", "a: 1\nb: «'»it''s", "a: 1\nb: {c: «{»d:"}) {
        expect_refused(text::Code::syntax, text);
        const std::string said = said_of(MarkedText(text).text);
        EXPECT_NE(said.find("is not closed before the file ends"), std::string::npos) << said;
    }
}

TEST(Document, WhatIsNeverClosedIsPointedAtWithWhatToPut) {
    for (const auto& [text, closer] :
         {std::pair{"a: «{»b: 1\nc: 2\n", "`}`"}, {"a: «[»b, c\nd: {e: 1}\n", "`]`"}, {"a: «\"»b\nc: 2\n", "`\"`"}}) {
        expect_refused(text::Code::syntax, text);
        const std::string said = said_of(MarkedText(text).text);
        EXPECT_NE(said.find("is never closed. Put " + std::string(closer)), std::string::npos) << said;
    }
}

TEST(Document, QuotesAndBracketsWithinATextOpenNothing) {
    text::Diagnostics diagnostics;
    EXPECT_TRUE(
        parse_document(
            "file.yaml",
            "a: it's 5\" long [or so\nb: >-\n  \"folded {\n  [text\nc: \"two\n  lines\"\n# [ {\nd: '# no comment'\n")
            .take(diagnostics));
    EXPECT_TRUE(diagnostics.empty()) << to_text(diagnostics);
}

TEST(Report, WhatIsMissingFromAFileWithoutALineEndMayBeCutOffAndThatIsSaidOnce) {
    for (const auto& [text, is_cut] : {std::pair{"a: 1\nb: 2", true}, {"a: 1\nb: 2\n", false}}) {
        const Document document("file.yaml", text);
        text::Diagnostics diagnostics;
        Report report(document, diagnostics);
        report.error(text::Code::missing_key, {0, 1}, "It needs `c:`.");
        report.error(text::Code::missing_key, {0, 1}, "It needs `d:`.");
        EXPECT_EQ(diagnostics[0].message,
                  is_cut ? "It needs `c:`. The last line, 2, has no line end: is the file cut off?" : "It needs `c:`.");
        EXPECT_EQ(diagnostics[1].message, "It needs `d:`.");
    }
}

TEST(Document, SyntaxErrorsAreSaidInWords) {
    EXPECT_NE(said_of("a:\n\tb: 1\n").find("Indent with spaces"), std::string::npos) << said_of("a:\n\tb: 1\n");
    EXPECT_NE(said_of("a: b: c\n").find("into quotation marks"), std::string::npos);
    EXPECT_NE(said_of("a:\n    b: 1\n  c: 2\n").find("indented like none above it"), std::string::npos)
        << said_of("a:\n    b: 1\n  c: 2\n");
    EXPECT_NE(said_of("a: [@b]\n").find("quotation marks"), std::string::npos);
}

TEST(Document, RefusesWhatIsNotYaml) { expect_refused(text::Code::syntax, "a: 1\nb: 2«:» 3\n"); }
TEST(Document, ReportsAMissingSpaceOnItsOwnLine) {
    expect_refused(text::Code::syntax, "a: 1\n«title:Drill»\nb: 2\n");
    expect_refused(text::Code::syntax, "steps:\n  - id: drill\n    «title:Drill»\n    axis: way\n");
    expect_refused(text::Code::syntax, "steps:\n  - id: drill\n    «title:Drill»\n  - id: b\n");
    expect_refused(text::Code::syntax, "hand: {«feed:1 mm/s», push: 5 N}\n");
    expect_refused(text::Code::syntax, "path:\n  - {depth: 1 mm}\n  «-{depth: 2 mm}»\nb: 1\n");
    text::Diagnostics diagnostics;
    parse_document("file.yaml", "a: 1\ntitle:Drill\nb: 2\n").take(diagnostics);
    EXPECT_EQ(diagnostics.at(0).write, "title: Drill");
}

TEST(Document, ReportsAMissingColonOnItsOwnLine) {
    expect_refused(text::Code::syntax, "a: 1\n«b 2»\nc: 3\n");
    expect_refused(text::Code::syntax, "a: 1\n«b = 2»  # why\n\nc: 3\n");
}

TEST(Document, NamesBlanksThatAreNoneByTheirCodePoint) {
    EXPECT_NE(said_of("depth:\u00A05 mm\nb: 1\n").find("U+00A0 (no-break space)"), std::string::npos);
    EXPECT_NE(said_of("a:\n  b: 1\n\u00A0 c: 2\n").find("begins with U+00A0"), std::string::npos);
    EXPECT_NE(said_of("title: \u201CHole: deep\u201D\n").find("U+201C (quotation mark)"), std::string::npos);
}

TEST(Document, RefusesSignsThatShowNothingAndReadsOn) {
    expect_refused(text::Code::not_text, "a: x«\u2028»y\n");
    expect_refused(text::Code::not_text, "a: x  # «\u202E»comment\n");
    expect_refused(text::Code::not_text, "a: x«\u0085»\n");
    expect_refused(text::Code::not_text, "a: «\"\\x1b[31m\"»\n");
    text::Diagnostics diagnostics;
    parse_document("file.yaml", "a: x\u2028\na: 1\n").take(diagnostics);
    ASSERT_EQ(diagnostics.size(), 2u) << to_text(diagnostics);
    EXPECT_EQ(diagnostics[1].code, text::code_text(text::Code::duplicate_key));
}

TEST(Document, RefusesBytesThatAreNotUtf8) { expect_refused(text::Code::not_text, "a: b\nc: «\xFF»\n"); }
TEST(Document, RefusesControlCharacters) { expect_refused(text::Code::not_text, "a: b\nc: x«\x04»\n"); }

TEST(Document, RefusesAnAliasAndItsAnchor) {
    text::Diagnostics diagnostics;
    parse_document("file.yaml", "a: &x 1\nb: *x\n").take(diagnostics);
    ASSERT_EQ(diagnostics.size(), 2u) << to_text(diagnostics);
    EXPECT_EQ(diagnostics[1].code, text::code_text(text::Code::anchor_or_alias));
    EXPECT_EQ(diagnostics[1].place.line, 2);
    EXPECT_EQ(diagnostics[1].place.column, 4);
}

TEST(Document, RefusesTheSixtyFifthLevel) {
    expect_refused(text::Code::nested_too_deep, std::string(64, '[') + "«[»a]" + std::string(64, ']'));
    text::Diagnostics diagnostics;
    parse_document("file.yaml", std::string(64, '[') + "a" + std::string(64, ']')).take(diagnostics);
    EXPECT_TRUE(diagnostics.empty()) << to_text(diagnostics);
}

TEST(Document, RefusesAFileThatSaysNothing) {
    for (const char* text : {"", "\n\n", "# only a comment\n", "---\n", "~\n"}) {
        text::Diagnostics diagnostics;
        EXPECT_FALSE(parse_document("file.yaml", text).take(diagnostics));
        ASSERT_EQ(diagnostics.size(), 1u) << text;
        EXPECT_EQ(diagnostics[0].code, text::code_text(text::Code::file_empty));
    }
}

TEST(Document, RefusesMoreThanOneMegabyte) {
    text::Diagnostics diagnostics;
    EXPECT_FALSE(parse_document("file.yaml", std::string((1u << 20) + 1, 'a')).take(diagnostics));
    ASSERT_EQ(diagnostics.size(), 1u);
    EXPECT_EQ(diagnostics[0].code, text::code_text(text::Code::file_too_large));
}

TEST(Document, ShowsAtMostAHundredErrorsThenSaysSo) {
    std::string text;
    for (int i = 0; i < 5000; ++i) text += "a: 1\n";
    text::Diagnostics diagnostics;
    parse_document("file.yaml", text).take(diagnostics);
    ASSERT_EQ(diagnostics.size(), 101u);
    EXPECT_EQ(diagnostics.back().code, text::code_text(text::Code::too_many_errors));
}

TEST(TextFile, ThatIsMissingOrAFolderIsRefused) {
    for (const std::string& file :
         {std::string("no/such/file.yaml"), std::filesystem::temp_directory_path().string()}) {
        text::Diagnostics diagnostics;
        EXPECT_FALSE(read_text_file(file).take(diagnostics));
        ASSERT_EQ(diagnostics.size(), 1u);
        EXPECT_EQ(diagnostics[0].code, text::code_text(text::Code::file_unreadable));
        EXPECT_EQ(diagnostics[0].place.line, 0);
    }
}

TEST(DiagnosticText, UnderlinesTheSourceLine) {
    text::Diagnostic diagnostic;
    diagnostic.code = "E0412";
    diagnostic.place = {"knee.yaml", 14, 13, 5};
    diagnostic.message = "drill.diameter is 65 mm, must be 0.5 mm … 20 mm.";
    diagnostic.write = "6.5 mm";
    diagnostic.source_line = "  diameter: 65 mm";
    EXPECT_EQ(text::to_text({diagnostic}),
              "E0412 knee.yaml:14:13: drill.diameter is 65 mm, must be 0.5 mm … 20 mm. Write `6.5 mm`.\n"
              "      diameter: 65 mm\n"
              "                ^^^^^\n");
}

TEST(DiagnosticText, SendsNoControlCharacterOfAFile) {
    text::Diagnostic diagnostic;
    diagnostic.code = "E0209";
    diagnostic.place = {"a\x1b.yaml", 1, 9, 1};
    diagnostic.message = "got `\x1b[31m`\u202E.";
    diagnostic.write = "\x07";
    diagnostic.source_line = "title: \x1b[31m";
    const std::string text = text::to_text({diagnostic});
    EXPECT_EQ(text, "E0209 a\\x1b.yaml:1:9: got `\\x1b[31m`\\u202e. Write `\\x07`.\n"
                    "    title: \\x1b[31m\n"
                    "               ^\n");
}

}  // namespace
}  // namespace kerf::documents
