// SPDX-License-Identifier: Apache-2.0
#include "documents/add_landmarks.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "documents/names.h"
#include "documents/read_anatomy.h"
#include "kerf/units.hpp"

namespace kerf::documents {
namespace {

using namespace literals;

const std::string head = R"(apiVersion: kerf/v1
kind: Anatomy
metadata: {id: ball, title: A ball}
phantom:
  parts: [{id: ball, sphere: {centre: 0 0 0 mm, radius: 20 mm}}]
tissues: [{id: cancellous, density: 0.25 g/cm3}]
)";
const std::string zones = "zones:\n  vital: [{sphere: {centre: 0 0 40 mm, radius: 5 mm}}]\n";

const NewLandmarks point_and_axis{
    .points = {{.id = "tip",
                .at = {1.234_mm, -0.004_mm, 20.0_mm},
                .tolerance = 1.0_mm,
                .lies = LandmarkPoint::Lies::on_bone}},
    .axes = {{.id = "shaft", .from = {0, 0, -20.0_mm}, .to = {0, 0, 20.0_mm}, .tolerance = 1.0_mm}}};
const std::string tip = "tip: {at: 1.23 0 20 mm, tolerance: 1 mm, lies: on_bone}",
                  shaft = "shaft: {from: 0 0 -20 mm, to: 0 0 20 mm, tolerance: 1 mm}";

std::string added(const std::string& text, const NewLandmarks& landmarks = point_and_axis) {
    text::Diagnostics diagnostics;
    const auto result = with_landmarks("ball.yaml", text, landmarks).take(diagnostics);
    EXPECT_TRUE(result) << to_text(diagnostics);
    return result.value_or("");
}

std::string refusal(const std::string& text, const NewLandmarks& landmarks = point_and_axis) {
    text::Diagnostics diagnostics;
    EXPECT_FALSE(with_landmarks("ball.yaml", text, landmarks).take(diagnostics));
    return to_text(diagnostics);
}

TEST(AddLandmarks, WritesTheLinesBelowTheKey) {
    EXPECT_EQ(landmarks_text(point_and_axis), "  points:\n    " + tip + "\n  axes:\n    " + shaft + "\n");
    EXPECT_EQ(landmarks_text({}), "");
}

TEST(AddLandmarks, AppendsToBlocksAndKeepsComments) {
    const std::string text = head +
                             "landmarks:  # of mine\n"
                             "  points:\n"
                             "    # The first.\n"
                             "    crest: {at: 0 0 20 mm,\n"
                             "            tolerance: 2 mm}  # from above\n"
                             "    # Not measured: base\n"
                             "\n"
                             "  # Along the bone.\n"
                             "  axes:\n"
                             "      main: {from: 0 0 30 mm, to: 0 0 0 mm, tolerance: 2 mm}\n"
                             "\n"
                             "# Vessels.\n" +
                             zones;
    std::string expected = text;
    expected.insert(expected.find("\n  # Along"), "    " + tip + "\n");
    expected.insert(expected.find("\n# Vessels"), "      " + shaft + "\n");
    EXPECT_EQ(added(text), expected);
}

TEST(AddLandmarks, AddsToFlowMaps) {
    const std::string text =
        head + "landmarks: { points: {crest: {at: 0 0 20 mm, tolerance: 2 mm}} }  # short\n" + zones;
    EXPECT_EQ(added(text), head + "landmarks: {axes: {" + shaft + "},  points: {" + tip +
                               ", crest: {at: 0 0 20 mm, tolerance: 2 mm}} }  # short\n" + zones);
}

TEST(AddLandmarks, AddsASectionThatIsMissing) {
    const std::string text =
        head + "landmarks:\n    axes:\n        main: {from: 0 0 30 mm, to: 0 0 0 mm, tolerance: 2 mm}\n" + zones;
    const std::string after = added(text, {.points = point_and_axis.points});
    EXPECT_EQ(after, head +
                         "landmarks:\n    axes:\n        main: {from: 0 0 30 mm, to: 0 0 0 mm, tolerance: 2 mm}\n"
                         "    points:\n      " +
                         tip + "\n" + zones);
}

TEST(AddLandmarks, AddsTheKeyThatIsMissing) {
    const std::string lines = "\nlandmarks:\n  points:\n    " + tip + "\n  axes:\n    " + shaft + "\n";
    EXPECT_EQ(added(head + zones), head + zones + lines);
    EXPECT_EQ(added(head + zones + "...\n"), head + zones + lines + "...\n");
    EXPECT_EQ(added(head + "landmarks:  # none yet\n" + zones),
              head + "landmarks:  # none yet\n  points:\n    " + tip + "\n  axes:\n    " + shaft + "\n" + zones);
}

TEST(AddLandmarks, KeepsLineEndsOfWindows) {
    std::string text = head + "landmarks:\n  points:\n    crest: {at: 0 0 20 mm, tolerance: 2 mm}\n" + zones;
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.replace(at, 1, "\r\n");
    const std::string after = added(text);
    std::string expected = text;
    expected.insert(expected.find("zones:"), "    " + tip + "\r\n  axes:\r\n    " + shaft + "\r\n");
    EXPECT_EQ(after, expected);
}

TEST(AddLandmarks, CompletesALastLineWithoutEnd) {
    const std::string text = head + "landmarks:\n  points:\n    crest: {at: 0 0 20 mm, tolerance: 2 mm}";
    EXPECT_EQ(added(text), text + "\n    " + tip + "\n  axes:\n    " + shaft + "\n");
}

TEST(AddLandmarks, ReadsBackWithinARounding) {
    const auto anatomy = read_anatomy_text("ball.yaml", added(head));
    ASSERT_TRUE(anatomy);
    const LandmarkPoint* point = find_id(anatomy->points, "tip");
    ASSERT_NE(point, nullptr);
    EXPECT_LT(length(point->at - point_and_axis.points[0].at), 0.01_mm);
    EXPECT_EQ(point->lies, LandmarkPoint::Lies::on_bone);
}

TEST(AddLandmarks, RefusesANameThatExists) {
    const std::string text = head + "landmarks:\n  points:\n    shaft: {at: 0 0 20 mm, tolerance: 2 mm}\n";
    EXPECT_NE(refusal(text).find("`shaft`"), std::string::npos) << refusal(text);
}

TEST(AddLandmarks, RefusesATextItCannotExtend) {
    EXPECT_NE(refusal(head + "landmarks: none\n"), "");
    EXPECT_NE(refusal("[1, 2]\n"), "");
    EXPECT_NE(refusal(""), "");
    EXPECT_NE(refusal(head + "landmarks: {points: {crest: {at: 0 0 20 mm, tolerance: 2 mm}\n"), "");
    EXPECT_NE(refusal(head + "landmarks:\n  points: &all\n    crest: {at: 0 0 20 mm, tolerance: 2 mm}\n"), "");
    // A mistake elsewhere is reported, and nothing is added.
    EXPECT_NE(refusal(head + "landmark: {}\n").find("landmark"), std::string::npos);
}

}  // namespace
}  // namespace kerf::documents
