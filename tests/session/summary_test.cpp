// SPDX-License-Identifier: Apache-2.0
#include "session/summary.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "synthetic_run.h"

namespace kerf::session {
namespace {

using Json = nlohmann::ordered_json;

Json read(const RunSummary& summary) { return Json::parse(summary_json(summary)); }

TEST(Summary, HasTheKeysThatScriptsDependOnInThisOrder) {
    std::vector<std::string> keys;
    const Json document = read(test::synthetic_summary());
    for (const auto& [key, value] : document.items()) keys.push_back(key);

    const std::vector<std::string> promised{
        "schema",     "notice",     "procedure",     "verdict", "reasons", "score",       "score_rules", "score_band",
        "deductions", "duration_s", "steps",         "metrics", "ticks",   "removed_mm3", "pieces",      "force_scale",
        "hash",       "versions",   "anatomy_notes", "variant", "hand",    "device"};
    EXPECT_EQ(keys, promised);
    EXPECT_EQ(document["schema"], 1);
}

TEST(Summary, AStepSaysWhetherAndWhenItWasDoneAndWhichLimitsBroke) {
    const Json step = read(test::synthetic_summary())["steps"][0];
    EXPECT_EQ(step, (Json{{"id", "pilot-hole"},
                          {"done", true},
                          {"start_s", 0.0},
                          {"end_s", 12.1},
                          {"limits", {"clearance to spinal-canal", "depth"}}}));
}

TEST(Summary, AMetricIsInItsOwnUnit) {
    const Json metric = read(test::synthetic_summary())["metrics"][0];
    EXPECT_EQ(metric["value"], 31.23456);
    EXPECT_EQ(metric["uncertainty"], 0.13);
    EXPECT_EQ(metric["unit"], "mm");
}

TEST(Summary, AnUncertaintyNotStatedIsNull) {
    EXPECT_TRUE(read(test::synthetic_summary())["metrics"][2]["uncertainty"].is_null());
}

TEST(Summary, VolumeIsInCubicMillimetresAndTheHashInHexadecimal) {
    const Json document = read(test::synthetic_summary());
    EXPECT_EQ(document["removed_mm3"], 220.0);
    EXPECT_EQ(document["hash"], "0123456789abcdef");
}

TEST(Summary, WhatIsNotFiniteIsNull) {
    RunSummary summary;
    summary.score = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(read(summary)["score"].is_null());
}

TEST(Summary, TextThatIsNotUnicodeDoesNotStopIt) {
    RunSummary summary;
    summary.procedure = "caf\xe9";
    EXPECT_NO_THROW(read(summary));
}

TEST(Summary, OfTheClockHasEachPercentileInMicroseconds) {
    RunSummary summary;
    summary.clock = ClockRow{};
    summary.clock->period = 1e-3;
    summary.clock->lateness = {.median = 20e-6, .p99 = 200e-6, .p999 = 900e-6, .worst = 1200e-6};
    summary.clock->compute = {.median = 30e-6, .p99 = 40e-6, .p999 = 50e-6, .worst = 60.5e-6};
    const Json clock = read(summary)["clock"];
    EXPECT_EQ(clock["period_ms"], 1.0);
    EXPECT_EQ(clock["lateness"],
              (Json{{"median_us", 20.0}, {"p99_us", 200.0}, {"p99_9_us", 900.0}, {"worst_us", 1200.0}}));
    EXPECT_EQ(clock["compute"], (Json{{"median_us", 30.0}, {"p99_us", 40.0}, {"p99_9_us", 50.0}, {"worst_us", 60.5}}));
}

TEST(Summary, EveryVerdictHasItsWord) {
    EXPECT_STREQ(to_text(Verdict::pass), "pass");
    EXPECT_STREQ(to_text(Verdict::fail), "fail");
    EXPECT_STREQ(to_text(Verdict::incomplete), "incomplete");
    EXPECT_STREQ(to_text(Verdict::invalid), "invalid");
}

}  // namespace
}  // namespace kerf::session
