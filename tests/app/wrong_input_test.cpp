// SPDX-License-Identifier: Apache-2.0
// A file of the wrong kind, a folder that keeps no files, too few open files: each message names what it is.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <tuple>

#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

namespace kerf {
namespace {

using test::Ended;
using test::kerf;

const std::string pedicle_screw = KERF_SOURCE_DIR "/procedures/pedicle-screw.yaml";
const std::string vertebra = KERF_SOURCE_DIR "/procedures/anatomy/vertebra-phantom.yaml";

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// One file of each kind that a user may take for another.
class OtherFile : public testing::Test {
protected:
    void SetUp() override {
        std::string head(100, '\0');
        head.replace(0, 15, "SQLite format 3").replace(68, 4, "KERF");
        write("session.db", head);
        write("README.md", "# Kerf\n\nKerf has three kinds of parts:\n\n* tools\n");
        write("bone.stl", "solid bone\nendsolid\n");
        write("report.html", "<!doctype html>\n<title>x</title>\n");
        write("picture.png", "\x89PNG\r\n\x1a\n");
    }
    void write(const std::string& name, const std::string& bytes) const {
        std::ofstream(folder_ / name, std::ios::binary) << bytes;
    }
    /// Checks that a command refuses a file of the folder with a message that has `part`.
    void expect_refused(const std::string& command, const std::string& name, const std::string& part) const {
        const Ended ended = kerf(command + " " + (folder_ / name));
        EXPECT_EQ(ended.exit_code, 2) << command << " " << name;
        EXPECT_TRUE(has(ended.out + ended.err, part)) << command << " " << name << ": " << ended.out << ended.err;
    }

    const test::TemporaryFolder folder_;
};

TEST_F(OtherFile, IsRefusedAsAProcedure) {
    for (const char* command : {"run", "validate", "expand", "rehearse", "preview", "anatomy check"}) {
        expect_refused(command, "session.db", "got a session of Kerf, expected a document in YAML. Write `kerf view ");
        expect_refused(command, "README.md", "got a text in Markdown, expected a document in YAML. ");
    }
    expect_refused("validate", "bone.stl", "got a surface mesh, expected a document in YAML. Write `kerf import ");
    expect_refused("validate", "report.html", "got a web page, expected a document in YAML. ");
    expect_refused("validate", "picture.png", "got a picture, expected a document in YAML. ");
    expect_refused("validate", "", "is the folder of a run, expected a file. Write `kerf view ");
}

TEST_F(OtherFile, IsRefusedAsASession) {
    for (const char* command : {"report", "remesh", "view"}) {
        expect_refused(command, "README.md", "got a text in Markdown, expected the session.db of a run. ");
        expect_refused(
            command, "",
            "got the folder of a run, expected the session.db of a run. Write `kerf " + std::string(command) + " ");
        expect_refused(command, "none.db", "cannot be opened: there is no such file. Name a session.db");
    }
    std::filesystem::copy_file(pedicle_screw, folder_ / "p.yaml");
    expect_refused("report", "p.yaml", "got a procedure, expected the session.db of a run. Write `kerf validate ");
}

TEST_F(OtherFile, IsRefusedAsAScanAPluginOrAComponent) {
    expect_refused("import", "session.db", "got a session of Kerf, expected a scan or a surface. ");
    expect_refused("check", "README.md",
                   "got a text in Markdown, expected a plugin, which is a shared library such as ");
    expect_refused("check", "README.md", " `kerf validate` checks procedures.");
    expect_refused("describe", "session.db", "got a session of Kerf, expected a plugin or a component");
    expect_refused("privacy", "", ": this is a folder. Name single files");
}

TEST(OtherFolder, ARunsSessionIsNamedForEveryCommandThatTakesOne) {
    const test::TemporaryFolder folder;
    std::filesystem::create_directory(folder / "first run");
    std::ofstream(folder / "first run/session.db") << "x";
    const std::string run = "'" + (folder / "first run") + "'",
                      session = "'" + (folder / "first run/session.db") + "'`.";
    for (const std::string command : {"report", "view", "remesh"}) {
        const Ended ended = kerf(command + " " + run);
        EXPECT_EQ(ended.exit_code, 2);
        EXPECT_TRUE(has(ended.err, "Write `kerf " + command + " " + session)) << ended.err;
    }
    const Ended replay = kerf("run " + pedicle_screw + " --replay " + run + "/");
    EXPECT_EQ(replay.exit_code, 2);
    EXPECT_TRUE(has(replay.err, "Write `--replay " + session)) << replay.err;
}

TEST(MissingFile, IsAnsweredWithTheNearestNameInItsFolder) {
    const test::TemporaryFolder folder;
    std::filesystem::copy_file(pedicle_screw, folder / "pedicle-screw.yaml");
    std::ofstream(folder / "pedicle-srew.txt") << "x";
    const Ended near = kerf("validate " + (folder / "pedicle-srew.yaml"));
    EXPECT_EQ(near.exit_code, 2);
    EXPECT_TRUE(has(near.out, "does not exist. Write `" + (folder / "pedicle-screw.yaml") + "`.")) << near.out;
    const Ended far = kerf("validate " + (folder / "femur.yaml"));
    EXPECT_TRUE(has(far.out, "does not exist. Check its name and its folder.")) << far.out;
}

TEST(OtherDevice, AModelIsNoDriver) {
    for (const std::string& command :
         {"run " + pedicle_screw + " --headless --device touch", std::string("devices test touch")}) {
        const Ended ended = kerf(command);
        EXPECT_EQ(ended.exit_code, 2) << command;
        EXPECT_TRUE(has(ended.err, "`touch` is a model of a device. Write `--set haptics.device=touch` to simulate it"))
            << ended.err;
        EXPECT_TRUE(has(ended.err, "`replay`")) << ended.err;
    }
}

TEST(OtherDocument, IsNamedWithTheCommandThatTakesIt) {
    const Ended anatomy = kerf("validate " + vertebra);
    EXPECT_EQ(anatomy.exit_code, 2);
    EXPECT_TRUE(has(anatomy.out, "got `Anatomy`, expected `Procedure`. Write `kerf anatomy check ")) << anatomy.out;
    const Ended procedure = kerf("anatomy check " + pedicle_screw);
    EXPECT_EQ(procedure.exit_code, 2);
    EXPECT_TRUE(has(procedure.out, "got `Procedure`, expected `Anatomy`. Write `kerf validate ")) << procedure.out;
}

TEST(AnatomyAlone, IsComparedWithItsBone) {
    const Ended checked = kerf("anatomy check " + vertebra);
    EXPECT_EQ(checked.exit_code, 0) << checked.out << checked.err;
    for (const char* part : {"Point midline: ", "Axis right_pedicle: meets bone ", "Zone canal: 0 % of it lies in bone",
                             "To check what a procedure needs of it, write `--for PROCEDURE.yaml`."})
        EXPECT_TRUE(has(checked.out, part)) << checked.out;
}

TEST(OpenFiles, AreTooFewWithANamedLimit) {
    for (const char* limit : {"6", "8", "10", "12", "24"}) {
        const Ended ended = test::shell(std::string("ulimit -n ") + limit + "; " KERF_BUILD_DIR "/bin/kerf list");
        EXPECT_EQ(ended.exit_code, 3) << limit;
        EXPECT_TRUE(has(ended.err, std::string("E0720 kerf: Too few files can be opened: got a limit of ") + limit) &&
                    has(ended.err, "Write `ulimit -n 1024`"))
            << ended.err;
        EXPECT_FALSE(has(ended.err, "plugin")) << ended.err;
    }
}

TEST(OpenFiles, SufficeAtASmallLimit) {
    const Ended listed = test::shell("ulimit -S -n 6; " KERF_BUILD_DIR "/bin/kerf list");
    EXPECT_EQ(listed.exit_code, 0) << listed.err;  // the program raises a soft limit
    const test::TemporaryFolder folder;
    const Ended ran = test::shell("ulimit -n 64; " KERF_BUILD_DIR "/bin/kerf run " + pedicle_screw +
                                  " --set 'time_limit=1 s' --out " + (folder / "out"));
    EXPECT_EQ(ran.exit_code, 1) << ran.out << ran.err;
    EXPECT_TRUE(std::filesystem::exists(folder / "out/report.html"));
}

TEST(SystemFolder, IsRefusedForResults) {
    for (const char* folder : {"/proc", "/proc/here", "/sys"}) {
        const Ended ended = kerf("run " + pedicle_screw + " --out " + folder);
        EXPECT_EQ(ended.exit_code, 2);
        EXPECT_TRUE(has(ended.err, std::string(folder) + " belongs to the system")) << ended.err;
    }
}

TEST(ReplayOfAnother, NamesItsProcedure) {
    const test::TemporaryFolder folder;
    const Ended made = kerf("run " + pedicle_screw + " --set 'time_limit=1 s' --out " + (folder / "out"));
    ASSERT_EQ(made.exit_code, 1) << made.out << made.err;
    const Ended other =
        kerf("run " KERF_SOURCE_DIR "/procedures/pedicle-awl.yaml --replay " + (folder / "out/session.db"));
    EXPECT_EQ(other.exit_code, 2);
    EXPECT_TRUE(has(other.err, "was recorded with the procedure `pedicle-screw`, and this is `pedicle-awl`. Name "
                               "`pedicle-screw`"))
        << other.err;
}

TEST(NoCommand, PrintsHelp) {
    const Ended ended = kerf("");
    EXPECT_EQ(ended.exit_code, 0);
    EXPECT_TRUE(has(ended.out, "Usage: kerf [OPTIONS] COMMAND")) << ended.out;
    EXPECT_EQ(ended.err, "");
}

TEST(SettingOfAnUnknownKey, SuggestsTheKeyThatIsThere) {
    const Ended ended = kerf("validate " + pedicle_screw + " --set 'accuracy.spcing=0.5 mm'");
    EXPECT_EQ(ended.exit_code, 2);
    EXPECT_TRUE(has(ended.out, "The key `spcing` is unknown") && has(ended.out, "Write `spacing:`.")) << ended.out;
}

}  // namespace
}  // namespace kerf
