// SPDX-License-Identifier: Apache-2.0
// `kerf window`, `kerf run --window` and `kerf view` as a user starts them. The window opens on a display without a
// screen.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include "tests/support/own_display.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

namespace kerf::test {
namespace {

constexpr const char* short_operation =
    "run " KERF_SOURCE_DIR "/procedures/pedicle-screw.yaml --anatomy " KERF_SOURCE_DIR
    "/procedures/anatomy/vertebra-phantom.yaml --set \"accuracy.spacing=0.5 mm\" --set \"time_limit=3 s\"";

/// Returns width and height in the header of a PNG file; zeros for another file.
std::pair<unsigned, unsigned> size_of_picture(const std::string& file) {
    const std::string bytes = contents_of(file);
    if (bytes.size() < 24 || bytes.substr(1, 3) != "PNG") return {};
    const auto number = [&](std::size_t at) {
        unsigned value = 0;
        for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
        return value;
    };
    return {number(16), number(20)};
}

TEST(Window, ShowsARunOnTheClockAndWritesItsLastPicture) {
    const OwnDisplay display;
    const TemporaryFolder folder;
    const std::string picture = folder / "end.png";
    const Ended ended =
        kerf(std::string(short_operation) + " --window --screenshot " + picture + " --out " + (folder / "run"));
    EXPECT_EQ(ended.exit_code, 1) << ended.err;  // three seconds are not enough
    EXPECT_NE(ended.out.find("verdict: incomplete"), std::string::npos) << ended.out << ended.err;
    EXPECT_NE(ended.out.find("clock: 300"), std::string::npos) << ended.out;
    EXPECT_EQ(size_of_picture(picture), std::pair(1280u, 800u)) << ended.err;
    EXPECT_TRUE(std::filesystem::exists(folder / "run/session.db"));
    EXPECT_TRUE(std::filesystem::exists(folder / "run/report.html"));

    // The recorded run is drawn without a display.
    const auto draw = [&](const std::string& options) {
        const std::string file = folder / "at-2-s.png";
        std::filesystem::remove(file);
        const Ended viewed =
            kerf("view " + (folder / "run/session.db") +
                     " --procedure " KERF_SOURCE_DIR "/procedures/pedicle-screw.yaml --anatomy " KERF_SOURCE_DIR
                     "/procedures/anatomy/vertebra-phantom.yaml --set \"accuracy.spacing=0.5 mm\" --set "
                     "\"time_limit=3 s\" --at 2 " +
                     options + " --screenshot " + file,
                 "DISPLAY=");
        EXPECT_EQ(viewed.exit_code, 0) << viewed.err;
        EXPECT_EQ(size_of_picture(file), std::pair(1280u, 800u)) << viewed.err;
        return contents_of(file);
    };
    EXPECT_NE(draw(""), draw("--inspect"));
}

TEST(Window, EndsWithASentenceWithoutADisplay) {
    const TemporaryFolder folder;
    const Ended ended =
        kerf(std::string(short_operation) + " --window --out " + (folder / "run"), "DISPLAY= WAYLAND_DISPLAY=");
    EXPECT_EQ(ended.exit_code, 3);
    EXPECT_NE(ended.err.find("no window can be opened"), std::string::npos) << ended.err;
    EXPECT_NE(ended.err.find("without `--window`"), std::string::npos) << ended.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "run/session.db"));
}

TEST(Window, RefusesOptionsThatDoNotFit) {
    const auto refused = [](const std::string& arguments, const std::string& words) {
        const Ended ended = kerf(std::string(short_operation) + arguments);
        EXPECT_EQ(ended.exit_code, 2) << arguments;
        EXPECT_NE(ended.err.find(words), std::string::npos) << ended.err;
    };
    refused(" --window --headless", "Leave out one of both");
    refused(" --screenshot end.png", "Add `--window`");
}

/// Writes the short operation as files of its own.
void write_short_operation(const std::string& folder) {
    const std::string shipped = KERF_SOURCE_DIR "/procedures/";
    std::filesystem::create_directory(folder);
    std::filesystem::copy_file(shipped + "anatomy/vertebra-phantom.yaml", folder + "/bone.yaml");
    std::string text = contents_of(shipped + "pedicle-screw.yaml");
    for (const auto& [from, to] : {std::pair<std::string, std::string>{"anatomy/vertebra-l3.yaml", "bone.yaml"},
                                   {"spacing: 0.25 mm", "spacing: 0.5 mm"},
                                   {"time_limit: 360 s", "time_limit: 1 s"}}) {
        ASSERT_NE(text.find(from), std::string::npos) << from;
        text.replace(text.find(from), from.size(), to);
    }
    std::ofstream(folder + "/screw.yaml") << text;
}

TEST(StartPage, StartsAnOperationAndReturns) {
    const OwnDisplay display;
    const TemporaryFolder folder;
    write_short_operation(folder / "own");
    const std::string attempt = folder / "attempts/L17/pedicle-screw/001";
    // A user: clicks `Start`, to operate by mouse, waits for the results, presses Enter, and closes the page. Keys are
    // pressed again until the window has them.
    std::ofstream(folder / "user.sh")
        << "#!/bin/sh\n" KERF_BUILD_DIR "/bin/kerf window --learner L17 --procedures " << folder / "own"
        << " --attempts " << folder / "attempts"
        << " & page=$!\n"
           "i=0; until [ -f "
        << attempt
        << "/report.html ] || [ $i -gt 100 ]; do\n"
           "  xdotool mousemove 1120 315 click 1; sleep 0.3; i=$((i + 1)); done\n"
           "i=0; while kill -0 $page 2> /dev/null && [ $i -lt 60 ]; do\n"
           "  xdotool key Return; sleep 0.3; xdotool key ctrl+q; sleep 0.3; i=$((i + 1)); done\n"
           "wait $page\n";
    const Ended ended = shell("sh " + (folder / "user.sh"));
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_TRUE(std::filesystem::exists(attempt + "/session.db")) << ended.err;
    EXPECT_NE(contents_of(attempt + "/summary.json").find("\"verdict\": \"incomplete\""), std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(folder / "attempts/L17/pedicle-screw/002"));
}

TEST(StartPage, RefusesOptionsBeforeItOpens) {
    const TemporaryFolder folder;
    const auto refused = [](const std::string& arguments, const std::string& words) {
        const Ended ended = kerf("window " + arguments, "DISPLAY= WAYLAND_DISPLAY=");
        EXPECT_EQ(ended.exit_code, 2) << arguments;
        EXPECT_NE(ended.err.find(words), std::string::npos) << ended.err;
    };
    refused("--learner 'Ann Lee'", "never a name");
    refused("--learner ..", "begins with `.`");
    refused("--procedures " + (folder / "missing"), "is no folder");
    std::ofstream(folder / "file") << "text";
    refused("--attempts " + (folder / "file"), folder / "file");
    const Ended ended = kerf("window --attempts " + (folder / "new"), "DISPLAY= WAYLAND_DISPLAY=");
    EXPECT_EQ(ended.exit_code, 3);
    EXPECT_NE(ended.err.find("no window can be opened"), std::string::npos) << ended.err;
}

TEST(View, ShowsTheSessionAloneWhenItsProcedureHasChanged) {
    const TemporaryFolder folder;
    write_short_operation(folder / "own");
    const std::string procedure = folder / "own/screw.yaml", session = folder / "run/session.db";
    ASSERT_EQ(kerf("run " + procedure + " --out " + (folder / "run")).exit_code, 1) << "a second is not enough";
    for (const char* at : {"0.5abc", "2", "0", "-1"}) {
        const Ended ended =
            kerf("run " + procedure + " --window --device mouse --continue " + session + " --at=" + at, "DISPLAY=");
        EXPECT_EQ(ended.exit_code, 2) << at;
        EXPECT_NE(ended.err.find("Write seconds from 0.001 to 1.000, as in"), std::string::npos) << ended.err;
    }
    std::ofstream(procedure, std::ios::app) << "# another text\n";
    const auto picture = [&](const std::string& options, const std::string& name) {
        const Ended ended = kerf("view " + session + options + " --screenshot " + (folder / name), "DISPLAY=");
        EXPECT_EQ(ended.exit_code, 0) << ended.err;
        EXPECT_NE(ended.err.find("From the record alone"), std::string::npos) << ended.err;
        EXPECT_EQ(size_of_picture(folder / name), std::pair(1280u, 800u)) << ended.err;
        return contents_of(folder / name);
    };
    EXPECT_NE(picture(" --at 0", "first.png"), picture(" --at 1", "last.png"));
    static_cast<void>(picture(" --recorded", "recorded.png"));

    const Ended refused =
        kerf("view " + session + " --procedure " + procedure + " --screenshot " + (folder / "none.png"), "DISPLAY=");
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_NE(refused.err.find("another text"), std::string::npos) << refused.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "none.png"));
    const Ended late = kerf("view " + session + " --recorded --at 99 --screenshot " + (folder / "none.png"));
    EXPECT_EQ(late.exit_code, 2);
    EXPECT_NE(late.err.find("the recording ends after 1.0 s"), std::string::npos) << late.err;
}

TEST(View, RefusesATimeThatIsNone) {
    for (const char* at : {"abc", "-1", "nan", "1e999", "3s"}) {
        const Ended ended = kerf("view nothing.db --screenshot a.png --at=" + std::string(at));
        EXPECT_EQ(ended.exit_code, 2) << at;
        EXPECT_NE(ended.err.find("Write seconds"), std::string::npos) << ended.err;
    }
}

TEST(View, RefusesAFileThatIsNoSession) {
    const Ended ended = kerf("view " KERF_SOURCE_DIR "/README.md --screenshot a.png");
    EXPECT_EQ(ended.exit_code, 2);
    EXPECT_FALSE(std::filesystem::exists("a.png"));
}

}  // namespace
}  // namespace kerf::test
