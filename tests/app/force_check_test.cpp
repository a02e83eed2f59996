// SPDX-License-Identifier: Apache-2.0
// `kerf devices test --force`, on the arm without hardware.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/support/program.h"

namespace kerf::app {
namespace {

using test::contents_of;
using test::Ended;
using test::TemporaryFolder;

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Runs the check with these answers on stdin.
Ended check_with(const TemporaryFolder& folder, const std::string& answers,
                 const std::string& device = "simulated_hand", const std::string& plugins = "") {
    return test::shell("printf '" + answers + "' | KERF_STATION=" + (folder / "station.yaml") +
                       (plugins.empty() ? "" : " KERF_PLUGIN_PATH=" + plugins) +
                       " " KERF_BUILD_DIR "/bin/kerf devices test " + device + " --force");
}

/// Runs the check of a knob on a spring of 0.5 N m/rad, with these answers.
Ended check_knob(const std::string& how, const std::string& answers) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "plugins");
    const std::string file = "driver_that_" + how + ".so";
    std::filesystem::copy(KERF_BUILD_DIR "/tests/bad_plugins/" + file, folder / ("plugins/" + file));
    return check_with(folder, answers, "still", folder / "plugins");
}

/// Returns the distance of the n-th push [mm] in what the check printed.
double distance_of(const std::string& out, int n) {
    std::size_t at = 0;
    for (int i = 0; i <= n; ++i) at = out.find("moved by ", at) + 9;
    return std::stod(out.substr(at));
}

TEST(ForceCheck, PushesAlongEachAxisAndKeepsWhatAPersonConfirms) {
    const TemporaryFolder folder;
    const Ended ended = check_with(folder, "\\ny\\n\\ny\\n\\ny\\n\\ny\\n\\ny\\n\\ny\\n");
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_TRUE(has(ended.out, "confirmed: ")) << ended.out;
    // The arm has 135 N/m: a push of 1 N moves it by 7.4 mm, and a little more as it swings.
    for (int n = 0; n < 6; ++n) EXPECT_NEAR(distance_of(ended.out, n), 1e3 / 135.0, 0.8) << n;
    EXPECT_TRUE(has(contents_of(folder / "confirmed-devices"), "simulated_hand simulated arm"));
    EXPECT_TRUE(has(contents_of(folder / "confirmed-devices"), "For training and research"));
}

TEST(ForceCheck, EndsWithThePushThatIsWrong) {
    const TemporaryFolder folder;
    const Ended ended = check_with(folder, "\\nn\\n\\ny\\n");
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_TRUE(has(ended.err, "the push to the right was not confirmed")) << ended.err;
    EXPECT_EQ(contents_of(folder / "confirmed-devices"), "");
}

TEST(ForceCheck, TurnsAKnobInBothDirections) {
    const Ended ended = check_knob("is_a_knob", "\\ny\\n\\ny\\n");
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_TRUE(has(ended.out, "clockwise, 0.1 N m for 2 s") && has(ended.out, "confirmed: ")) << ended.out;
    EXPECT_NEAR(distance_of(ended.out, 0), 0.2 * 180.0 / 3.14159265358979323846, 0.1);
    EXPECT_FALSE(has(ended.err, "sign")) << ended.err;
}

TEST(ForceCheck, NamesAKnobThatTurnsAgainstItsTorque) {
    const Ended ended = check_knob("is_a_reversed_knob", "\\nn\\n");
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_TRUE(has(ended.err, "the torque was ended: it moved by more than 10 deg against the torque")) << ended.err;
    EXPECT_TRUE(has(ended.err, "the sign of its driver or of its setup is wrong")) << ended.err;
}

TEST(ForceCheck, NeedsAPersonAndAForce) {
    const TemporaryFolder folder;
    const Ended alone = check_with(folder, "");
    EXPECT_EQ(alone.exit_code, 2);
    EXPECT_TRUE(has(alone.err, "no person answers")) << alone.err;
    EXPECT_TRUE(has(test::kerf("devices --force").err, "only `kerf devices test`"));
    EXPECT_TRUE(has(test::kerf("devices test --force").err, "which device?"));
}

}  // namespace
}  // namespace kerf::app
