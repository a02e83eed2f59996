// SPDX-License-Identifier: Apache-2.0
#include "devices/haply/arm_session.h"

#include <gtest/gtest.h>

#include <string>

namespace kerf::haply {
namespace {

using Phase = ArmSession::Phase;

/// Returns a message of the service with one arm and a grip.
std::string message(const std::string& force, const std::string& status = "{}", bool has_session = true) {
    return std::string(has_session ? R"({"session_id": 1, )" : "{") + R"("inverse3": [{"device_id": "049D",
        "config": {"type": "inverse3"}, "status": )" +
           status + R"(, "state": {"cursor_position": {"x": 0.1, "y": 0.0, "z": 0.0})" +
           (force.empty() ? "" : R"(, "current_cursor_force": {"x": 0, "y": 0, "z": )" + force + "}") +
           R"(}}], "verse_grip": [{"device_id": "g", "state": {"button": true,
               "orientation": {"w": 1, "x": 0, "y": 0, "z": 0}}}]})";
}

bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

TEST(ArmSession, FindsTheWordThatTheServiceTakes) {
    ArmSession session("", {});
    ASSERT_TRUE(session.take(message("0.0")));
    EXPECT_TRUE(has(session.command({1, 1, 1}), "profile"));
    EXPECT_EQ(session.phase(), Phase::tries);
    int messages = 0;
    while (has(session.command({9, 9, 9}), "vector") && ++messages < 1000) ASSERT_TRUE(session.take(message("0.0")));
    const std::string trial = session.command({9, 9, 9});
    EXPECT_TRUE(has(trial, "values")) << "the service took no force for the other word";
    EXPECT_TRUE(has(trial, "0.05")) << trial;
    EXPECT_FALSE(has(trial, "9.0")) << "no force of the loop before the word is known";
    ASSERT_TRUE(session.take(message("0.05")));
    EXPECT_EQ(session.phase(), Phase::runs);
    EXPECT_TRUE(has(session.command({9, 0, 0}), "9.0"));
}

TEST(ArmSession, RefusesAServiceThatTakesNoForce) {
    ArmSession session("", {});
    ASSERT_TRUE(session.take(message("0.0")));
    int messages = 0;
    while (session.take(message("0.0")) && ++messages < 1000) static_cast<void>(session.command({}));
    EXPECT_EQ(session.phase(), Phase::refused);
    EXPECT_TRUE(has(session.problem(), "settings: {service")) << session.problem();
}

TEST(ArmSession, NeedsNoTrialWhereTheVersionIsStated) {
    ArmSession session("", ForceWord::values);
    ASSERT_TRUE(session.take(message("0.0")));
    EXPECT_EQ(session.phase(), Phase::runs);
    ArmSession of_3_1("", {});
    ASSERT_TRUE(of_3_1.take(message("", "{}", false)));
    EXPECT_EQ(of_3_1.phase(), Phase::runs) << "3.1 does not show its force, and knows one word";
    EXPECT_TRUE(has(of_3_1.command({}), "values"));
}

TEST(ArmSession, RefusesAnArmThatMustMakeNoForce) {
    struct Case {
        const char* status;
        const char* word;
    };
    for (const auto& [status, word] :
         {Case{R"({"calibrated": false})", "inkwell"}, Case{R"({"in_use": true})", "another program"},
          Case{R"({"power_supply": false})", "power supply"}, Case{R"({"ready": false})", "not ready"}}) {
        ArmSession session("", {});
        EXPECT_FALSE(session.take(message("0.0", status)));
        EXPECT_TRUE(has(session.problem(), word)) << session.problem();
    }
    ArmSession other("0000", {});
    EXPECT_FALSE(other.take(message("0.0")));
    EXPECT_TRUE(has(other.problem(), "`049D`")) << other.problem();
    ArmSession none("", {});
    EXPECT_FALSE(none.take(R"({"session_id": 1, "inverse3": []})"));
    EXPECT_TRUE(has(none.problem(), "no Inverse3")) << none.problem();
}

TEST(ArmSession, LosesAnArmAndTakesItBack) {
    ArmSession session("", ForceWord::vector);
    ASSERT_TRUE(session.take(message("0.0")));
    EXPECT_EQ(session.state().flags, std::uint32_t{KERF_DEVICE_VALID});
    EXPECT_EQ(session.state().buttons, 1u);
    ASSERT_TRUE(session.take(R"({"session_id": 1, "inverse3": []})"));
    EXPECT_EQ(session.state().flags, 0u);
    EXPECT_TRUE(has(session.problem(), "unplugged"));
    ASSERT_TRUE(session.take(message("0.0", R"({"calibrated": false})")));
    EXPECT_EQ(session.state().flags, 0u);
    const std::uint64_t reports = session.state().reports;
    ASSERT_TRUE(session.take(message("0.0")));
    EXPECT_EQ(session.state().flags, std::uint32_t{KERF_DEVICE_VALID});
    EXPECT_EQ(session.state().reports, reports + 1);
    EXPECT_EQ(session.problem(), "");
}

TEST(ArmSession, ConcernsItselfAlone) {
    ArmSession session("", ForceWord::vector);
    ASSERT_TRUE(session.take(message("0.0")));
    EXPECT_TRUE(session.concerns({.name = "x", .device = "049D", .safety = ""}));
    EXPECT_TRUE(session.concerns({.name = "x", .device = "g", .safety = ""}));
    EXPECT_TRUE(session.concerns({.name = "x", .device = "", .safety = ""}));
    EXPECT_FALSE(session.concerns({.name = "x", .device = "0000", .safety = ""}));
}

}  // namespace
}  // namespace kerf::haply
