// SPDX-License-Identifier: Apache-2.0
// `kerf run --window` and `kerf view` as a user starts them. The window opens on a display without a screen.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

namespace kerf::test {
namespace {

constexpr const char* short_operation =
    "run " KERF_SOURCE_DIR "/procedures/pedicle-screw.yaml --anatomy " KERF_SOURCE_DIR
    "/procedures/anatomy/vertebra-phantom.yaml --set \"accuracy.spacing=0.5 mm\" --set \"time_limit=3 s\"";

/// Returns what precedes a command that needs a display: it gets one of its own.
std::string on_display() { return "xvfb-run --auto-servernum --server-args=\"-screen 0 1300x850x24\""; }

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
    const TemporaryFolder folder;
    const std::string picture = folder / "end.png";
    const Ended ended =
        kerf(std::string(short_operation) + " --window --screenshot " + picture + " --out " + (folder / "run"),
             on_display());
    EXPECT_EQ(ended.exit_code, 1) << ended.err;  // three seconds are not enough
    EXPECT_NE(ended.out.find("verdict: incomplete"), std::string::npos) << ended.out << ended.err;
    EXPECT_NE(ended.out.find("clock: 300"), std::string::npos) << ended.out;
    EXPECT_EQ(size_of_picture(picture), std::pair(1280u, 800u)) << ended.err;
    EXPECT_TRUE(std::filesystem::exists(folder / "run/session.db"));
    EXPECT_TRUE(std::filesystem::exists(folder / "run/report.html"));

    // The recorded run is drawn without a display.
    const std::string at_2_s = folder / "at-2-s.png";
    const Ended viewed =
        kerf("view " + (folder / "run/session.db") +
                 " --procedure " KERF_SOURCE_DIR "/procedures/pedicle-screw.yaml --anatomy " KERF_SOURCE_DIR
                 "/procedures/anatomy/vertebra-phantom.yaml --set \"accuracy.spacing=0.5 mm\" --set "
                 "\"time_limit=3 s\" --at 2 --screenshot " +
                 at_2_s,
             "DISPLAY=");
    EXPECT_EQ(viewed.exit_code, 0) << viewed.err;
    EXPECT_EQ(size_of_picture(at_2_s), std::pair(1280u, 800u)) << viewed.err;
}

TEST(Window, EndsWithASentenceWithoutADisplay) {
    const TemporaryFolder folder;
    const Ended ended =
        kerf(std::string(short_operation) + " --window --out " + (folder / "run"), "DISPLAY= WAYLAND_DISPLAY=");
    EXPECT_EQ(ended.exit_code, 3);
    EXPECT_NE(ended.err.find("no window can be opened"), std::string::npos) << ended.err;
    EXPECT_NE(ended.err.find("leave out `--window`"), std::string::npos) << ended.err;
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
