// SPDX-License-Identifier: Apache-2.0
// `kerf landmarks` as a user starts it. The window opens on a display without a screen.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/own_display.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

namespace kerf::test {
namespace {

const std::string ball = R"(apiVersion: kerf/v1
kind: Anatomy
metadata: {id: ball, title: A ball}
phantom:
  parts: [{id: ball, sphere: {centre: 3 -4 5 mm, radius: 20 mm}}]
tissues: [{id: cancellous, density: 0.25 g/cm3}]
)";

TEST(Landmarks, WritesAnAxisThatIsClicked) {
    const OwnDisplay display;
    const TemporaryFolder folder;
    const std::string file = folder / "ball.yaml";
    std::ofstream(file) << ball;
    // A user: clicks two points, joins them, writes, and closes the window. All is done again until the window has it.
    std::ofstream(folder / "user.sh")
        << "#!/bin/sh\n" KERF_BUILD_DIR "/bin/kerf landmarks " << file
        << " & window=$!\n"
           "i=0; until grep -q axis_1 "
        << file
        << " || [ $i -gt 60 ]; do\n"
           "  xdotool mousemove 730 360 click 1; sleep 0.2; xdotool mousemove 850 440 click 1; sleep 0.2\n"
           "  xdotool key a; sleep 0.2; xdotool key ctrl+s; sleep 0.3; i=$((i + 1)); done\n"
           "i=0; while kill -0 $window 2> /dev/null && [ $i -lt 60 ]; do\n"
           "  xdotool key ctrl+q; sleep 0.3; i=$((i + 1)); done\n"
           "wait $window\n";
    const Ended ended = shell("sh " + (folder / "user.sh"));
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    const std::string text = contents_of(file);
    EXPECT_TRUE(text.starts_with(ball + "\nlandmarks:\n  ")) << text;
    EXPECT_NE(text.find("axis_1: {from: "), std::string::npos) << text << ended.err;
    // The file is an anatomy: the next landmark can be picked.
    EXPECT_EQ(kerf("landmarks " + file + " --point \"back=3 80 5 mm, 3 0 5 mm\" --write").exit_code, 0);
    EXPECT_NE(contents_of(file).find("back: {at: 3 16 5 mm, "), std::string::npos) << contents_of(file);
}

TEST(Landmarks, PrintsPointsAndAxesOfRays) {
    const TemporaryFolder folder;
    std::ofstream(folder / "ball.yaml") << ball;
    const Ended ended = kerf("landmarks " + (folder / "ball.yaml") +
                                 " --point \"back=3 80 5 mm, 3 0 5 mm\" --axis \"across=-9 -0.4 0.5 cm, 0 -4 5 mm; "
                                 "90 -4 5 mm, 0 -4 5 mm\" --screenshot " +
                                 (folder / "ball.png") + " --side back",
                             "DISPLAY= WAYLAND_DISPLAY=");
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_EQ(ended.out, "  points:\n    back: {at: 3 16 5 mm, tolerance: 1 mm, lies: on_bone}\n"
                         "  axes:\n    across: {from: -17 -4 5 mm, to: 23 -4 5 mm, tolerance: 1 mm}\n");
    EXPECT_EQ(contents_of(folder / "ball.png").substr(1, 3), "PNG");
    EXPECT_EQ(contents_of(folder / "ball.yaml"), ball);
}

TEST(Landmarks, RefusesWithASentence) {
    const TemporaryFolder folder;
    std::ofstream(folder / "ball.yaml") << ball;
    std::ofstream(folder / "other.yaml") << "kind: Procedure\napiVersion: kerf/v1\n";
    const auto refused = [&](const std::string& arguments, const std::string& words, int code = 2) {
        const Ended ended = kerf("landmarks " + folder.path() + "/" + arguments, "DISPLAY= WAYLAND_DISPLAY=");
        EXPECT_EQ(ended.exit_code, code) << arguments;
        EXPECT_NE(ended.err.find(words), std::string::npos) << arguments << ": " << ended.err;
        EXPECT_EQ(contents_of(folder / "ball.yaml"), ball);
    };
    refused("ball.yaml", "no window can be opened", 3);
    refused("missing.yaml --point \"a=0 0 80 mm, 0 0 0 mm\"", "E0101");
    refused("other.yaml --point \"a=0 0 80 mm, 0 0 0 mm\"", "E02");
    refused("ball.yaml --write", "no landmarks to write");
    refused("ball.yaml --spacing 1 --point \"a=0 0 80 mm, 0 0 0 mm\"", "`--spacing`");
    refused("ball.yaml --write --point \"a=0 0 80 mm, 0 0 90 mm\"", "meets no bone");
    refused("ball.yaml --write --point \"a=0 0 80 mm\"", "two points with a comma");
    refused("ball.yaml --write --point \"a=0 0 80 mm, 0 0 80 mm\"", "are the same");
    refused("ball.yaml --write --point \"a=0 0 80, 0 0 0 mm\"", "unit");
    refused("ball.yaml --write --point \"a b=0 0 80 mm, 0 0 0 mm\"", "a letter or digit first");
    refused("ball.yaml --write --axis \"a=0 0 80 mm, 0 0 0 mm\"", "has one ray");
    refused("ball.yaml --write --point \"a=0 0 80 mm, 0 0 0 mm\" --point \"a=0 9 80 mm, 0 0 0 mm\"", "twice");
}

}  // namespace
}  // namespace kerf::test
