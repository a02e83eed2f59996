// SPDX-License-Identifier: Apache-2.0
// `kerf devices test --force`, on the arm without hardware.
#include <gtest/gtest.h>

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
                 const std::string& device = "simulated_hand") {
    return test::shell("printf '" + answers + "' | KERF_STATION=" + (folder / "station.yaml") +
                       " " KERF_BUILD_DIR "/bin/kerf devices test " + device + " --force");
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
