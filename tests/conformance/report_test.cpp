// SPDX-License-Identifier: Apache-2.0
#include "conformance/report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace kerf::conformance {
namespace {

PluginReport report() {
    return {
        "lib/peck.so",
        "example.peck 0.1.0",
        {{"load.file", 1, "", "It is whole.", Status::passed, "", "", 0.001},
         {"law.finite", 3, "peck with pecking", "Every number is finite.", Status::failed,
          "channel 0: `delta` is <nan>", "oh\n", 0.25},
         {"law.time", 3, "peck with pecking", "It keeps to its time.", Status::warned, "it is slow", "", 0.1},
         {"law.pure", 3, "peck with pecking", "It is pure.", Status::skipped, "law.answers must pass first", "", 0.0},
         {"law.moved", 3, "peck with pecking", "It may be moved.", Status::skipped, "law.answers must pass first", "",
          0.0}},
        {"one `resist` of peck with pecking: 1234 instructions"},
        ""};
}

TEST(CheckReport, CountsWhatRanAndWhatDidNot) {
    EXPECT_EQ(
        summary_of(report()),
        "example.peck 0.1.0: 3 of 5 tests run, 1 failed, 1 with a warning, 2 skipped: law.answers must pass first "
        "(2).\n"
        "  one `resist` of peck with pecking: 1234 instructions\n");
    EXPECT_FALSE(is_conforming(report()));
}

TEST(CheckReport, AWarningDoesNotFail) {
    PluginReport sound = report();
    sound.results.erase(sound.results.begin() + 1);
    EXPECT_TRUE(is_conforming(sound));
    sound.results.clear();
    EXPECT_FALSE(is_conforming(sound)) << "nothing was tested";
}

TEST(CheckReport, AFailureHasItsCauseAndTheLineThatRepeatsIt) {
    const std::string text = text_of(report().results[1], "my plugins/peck.so");
    EXPECT_NE(text.find("FAILED law.finite  of peck with pecking\n"), std::string::npos) << text;
    EXPECT_NE(text.find("        | oh\n"), std::string::npos) << text;
    EXPECT_NE(text.find("Again: kerf check 'my plugins/peck.so' --level 3 --only '^law\\.finite$'\n"),
              std::string::npos)
        << text;
    EXPECT_EQ(text_of(report().results[0], "peck.so"), "");
}

TEST(CheckReport, JsonHoldsEachTest) {
    const auto json = nlohmann::json::parse(json_text({report()}));
    ASSERT_EQ(json["plugins"].size(), 1u);
    EXPECT_EQ(json["plugins"][0]["conforming"], false);
    EXPECT_EQ(json["plugins"][0]["tests"][1]["status"], "failed");
    EXPECT_NE(json["notice"].get<std::string>().find("not for diagnosis"), std::string::npos);
}

TEST(CheckReport, JunitIsEscapedAndCounted) {
    const std::string xml = junit_text({report()});
    EXPECT_NE(xml.find("tests=\"5\" failures=\"1\" errors=\"0\" skipped=\"2\""), std::string::npos) << xml;
    EXPECT_NE(xml.find("<failure message=\"channel 0: `delta` is &lt;nan&gt;\">oh&#10;</failure>"), std::string::npos)
        << xml;
    EXPECT_NE(xml.find("time=\"0.250\""), std::string::npos) << xml;
}

}  // namespace
}  // namespace kerf::conformance
