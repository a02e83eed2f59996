// SPDX-License-Identifier: Apache-2.0
#include "app/findings.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <vector>

namespace kerf::app {
namespace {

std::vector<Findings> two_files() {
    text::Diagnostic d;
    d.code = "E0412";
    d.place = {"a,b.yaml", 14, 22, 5};
    d.message = "drill.diameter is 65 mm: 100 % wrong.";
    d.write = "6.5 mm";
    return {{"a,b.yaml", {d}}, {"good.yaml", {}}};
}

TEST(Findings, NameEveryFileInText) {
    EXPECT_EQ(findings_text(two_files(), "text"),
              "E0412 a,b.yaml:14:22: drill.diameter is 65 mm: 100 % wrong. Write `6.5 mm`.\ngood.yaml: no errors\n");
}

TEST(Findings, EscapeWorkflowCommands) {
    EXPECT_EQ(findings_text(two_files(), "github"),
              "::error file=a%2Cb.yaml,line=14,col=22,title=E0412::drill.diameter is 65 mm: 100 %25 wrong. Write `6.5 "
              "mm`.\n");
}

TEST(Findings, HaveEveryPartInJson) {
    const auto document = nlohmann::json::parse(findings_text(two_files(), "json"));
    EXPECT_EQ(document["schema"], 1);
    ASSERT_EQ(document["files"].size(), 2u);
    EXPECT_EQ(document["files"][0]["has_errors"], true);
    const auto& d = document["files"][0]["diagnostics"][0];
    EXPECT_EQ(d["code"], "E0412");
    EXPECT_EQ(d["level"], "error");
    EXPECT_EQ(d["line"], 14);
    EXPECT_EQ(d["column"], 22);
    EXPECT_EQ(d["write"], "6.5 mm");
    EXPECT_EQ(document["files"][1]["has_errors"], false);
}

TEST(Findings, HaveThePositionOfTheReason) {
    std::vector<Findings> files = two_files();
    text::Reason& reason = files[0].diagnostics[0].reason.emplace();
    reason.place = {"base.yaml", 3, 7, 2};
    reason.message = "it stands here first.";
    reason.source_line = "  abcdef";
    EXPECT_EQ(to_text(files[0].diagnostics),
              "E0412 a,b.yaml:14:22: drill.diameter is 65 mm: 100 % wrong. Write `6.5 mm`.\n"
              "  because of base.yaml:3:7: it stands here first.\n      abcdef\n          ^^\n");
    const auto json = nlohmann::json::parse(findings_text(files, "json"));
    EXPECT_EQ(json["files"][0]["diagnostics"][0]["reason"]["line"], 3);
    EXPECT_EQ(json["files"][0]["diagnostics"][0]["reason"]["message"], "it stands here first.");
    EXPECT_TRUE(findings_text(files, "github")
                    .ends_with("Write `6.5 mm`.%0Abecause of base.yaml:3:7: it stands here first.\n"));
}

}  // namespace
}  // namespace kerf::app
