// SPDX-License-Identifier: Apache-2.0
#include "devices/haply/service_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace kerf::haply {
namespace {

/// The values of the example of docs.haply.co, "Simulation Channel", 3.1: the first message.
constexpr const char* first_of_3_1 = R"({
  "inverse3": [{
    "device_id": "04BA",
    "config": {"type": "inverse3", "handedness": "right"},
    "state": {
      "angular_position": {"a0": -69.31704, "a1": 137.62952, "a2": 19.832787},
      "body_orientation": {"x": -0.01940918, "y": 0.7026367, "z": 0.00048828125, "w": 0.7113037},
      "cursor_position": {"x": 0.07842738, "y": -0.14836666, "z": 0.14297646},
      "cursor_velocity": {"x": -0.011969013, "y": 0.0012009288, "z": -0.043197},
      "mode": "idle"},
    "status": {"calibrated": false, "in_use": false, "power_supply": true, "ready": true, "started": true}}],
  "verse_grip": [{
    "device_id": "61548",
    "config": {"port": "COM3", "type": "verse_grip"},
    "state": {"button": true, "hall": 0,
              "orientation": {"x": -0.5019531, "y": 0.8632202, "z": -0.048095703, "w": -0.022338867}}}]
})";

ServiceState read(const std::string& text) {
    std::string fault;
    const auto state = read_state(text, fault);
    EXPECT_TRUE(state) << fault;
    return state.value_or(ServiceState{});
}

std::string fault_of_text(const std::string& text) {
    std::string fault;
    EXPECT_FALSE(read_state(text, fault));
    return fault;
}

TEST(ServiceText, ReadsTheExampleOfTheMakersPage) {
    const ServiceState state = read(first_of_3_1);
    EXPECT_FALSE(state.has_session);
    const Arm* const arm = state.arm("04BA");
    ASSERT_NE(arm, nullptr);
    EXPECT_EQ(arm->type, "inverse3");
    ASSERT_TRUE(arm->position);
    EXPECT_EQ(arm->position->x, 0.07842738) << "right";
    EXPECT_EQ(arm->position->y, 0.14297646) << "up";
    EXPECT_EQ(arm->position->z, 0.14836666) << "towards the user";
    EXPECT_FALSE(arm->force) << "3.1 does not show it";
    EXPECT_FALSE(arm->is_calibrated);
    EXPECT_TRUE(arm->is_ready);
    const Grip* const grip = state.grip("61548");
    ASSERT_NE(grip, nullptr);
    ASSERT_TRUE(grip->rotation);
    EXPECT_NEAR(grip->rotation->w, -0.022338867, 1e-4);
    EXPECT_NEAR(grip->rotation->x, -0.5019531, 1e-3);
    EXPECT_NEAR(grip->rotation->y, -0.048095703, 1e-4);
    EXPECT_NEAR(grip->rotation->z, -0.8632202, 1e-3);
    EXPECT_NEAR(length({grip->rotation->x, grip->rotation->y, grip->rotation->z}),
                std::sqrt(1.0 - grip->rotation->w * grip->rotation->w), 1e-12)
        << "a unit quaternion";
    EXPECT_EQ(grip->buttons, 1u);
}

TEST(ServiceText, TurnsAsItMoves) {
    // A quarter turn about the service's z axis, up, takes its x axis to its y axis: right to away from the user.
    const ServiceState state = read(
        R"({"inverse3": [], "wireless_verse_grip": [{"device_id": "g",
            "state": {"orientation": {"w": 0.70710678118654757, "x": 0, "y": 0, "z": 0.70710678118654757},
                      "buttons": {"a": false, "b": true, "c": true}}}]})");
    const Grip* const grip = state.grip("g");
    ASSERT_TRUE(grip != nullptr && grip->rotation);
    EXPECT_NEAR(length(rotate(*grip->rotation, {1, 0, 0}) - Vec3{0, 0, -1}), 0.0, 1e-12);
    EXPECT_EQ(grip->buttons, 6u);
}

TEST(ServiceText, WritesTheForceInTheFrameOfTheService) {
    EXPECT_EQ(force_command("049D", ForceWord::vector, {1.0, 2.0, 3.0}),
              R"({"inverse3":[{"commands":{"set_cursor_force":{"vector":{"x":1.0,"y":-3.0,"z":2.0}}},)"
              R"("device_id":"049D"}]})");
    EXPECT_NE(force_command("049D", ForceWord::values, {}).find("\"values\""), std::string::npos);
    EXPECT_EQ(force_command("a", ForceWord::vector, {NAN, 0, 0}), force_command("a", ForceWord::vector, {}))
        << "a force that is no number is none";
}

TEST(ServiceText, NamesKerfAndSetsTheFrameOnce) {
    const std::string first = first_command("049D", ForceWord::vector, true);
    EXPECT_NE(first.find(R"("profile":{"name":"kerf"})"), std::string::npos) << first;
    EXPECT_NE(first.find(R"("basis":{"permutation":"XYZ"})"), std::string::npos) << first;
    EXPECT_EQ(first_command("049D", ForceWord::values, false).find("basis"), std::string::npos);
}

TEST(ServiceText, RefusesWhatIsNoMessage) {
    for (const char* text : {"", "{", "[]", "7", "\"inverse3\"", "{}", "{\"x\": 1}", "\xff\xfe"})
        EXPECT_NE(fault_of_text(text), "") << text;
    EXPECT_NE(fault_of_text(std::string(max_message + 1, ' ')), "");
    EXPECT_NE(fault_of_text(std::string(100'000, '[')), "");
}

TEST(ServiceText, TakesNoPositionThatIsNoNumber) {
    for (const char* x : {"null", "\"0.1\"", "1e999", "[]", "true"}) {
        std::string fault;
        const auto state =
            read_state(std::string(R"({"inverse3": [{"device_id": "a", "state": {"cursor_position": {"x": )") + x +
                           R"(, "y": 0, "z": 0}}}]})",
                       fault);
        EXPECT_TRUE(!state || !state->arms.at(0).position) << x;
    }
    const ServiceState turned = read(
        R"({"inverse3": [], "verse_grip": [{"device_id": "g", "state": {"orientation": {"w": 0, "x": 0, "y": 0, "z": 0}}}]})");
    EXPECT_FALSE(turned.grips.at(0).rotation) << "no rotation";
}

TEST(ServiceText, NamesWhatAnEventMeans) {
    const auto event = read_event(
        R"({"name": "device-safety-triggered", "category": "device", "level": "error",
            "data": {"device_family": "inverse", "device_id": "049D", "safety_type": "ebrake_triggered"}, "message": ""})");
    ASSERT_TRUE(event);
    EXPECT_EQ(event->device, "049D");
    EXPECT_NE(problem_of(*event).find("emergency brake"), std::string::npos);
    EXPECT_NE(problem_of({.name = "device-busy"}).find("another program"), std::string::npos);
    EXPECT_EQ(problem_of({.name = "device-connected"}), "");
    EXPECT_EQ(problem_of({.name = "device-safety-triggered", .device = "", .safety = "ebrake_released"}), "");
    EXPECT_FALSE(read_event("{\"category\": \"device\"}"));
}

}  // namespace
}  // namespace kerf::haply
