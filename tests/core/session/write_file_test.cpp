// SPDX-License-Identifier: Apache-2.0
#include "core/session/write_file.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/session/recorder.h"
#include "tests/support/temporary_folder.h"

namespace kerf {
namespace {

namespace fs = std::filesystem;
using test::contents_of;
using test::TemporaryFolder;

TEST(WriteFile, ReplacesTheWholeFileAndLeavesNothingElse) {
    const TemporaryFolder folder;
    ASSERT_EQ(write_file(folder / "a.txt", "a longer text"), "");
    ASSERT_EQ(write_file(folder / "a.txt", "short"), "");
    EXPECT_EQ(contents_of(folder / "a.txt"), "short");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
}

TEST(WriteFile, SaysWhichFileCouldNotBeWritten) {
    const TemporaryFolder folder;
    const std::string error = write_file(folder / "missing/a.txt", "text");
    EXPECT_NE(error.find("a.txt could not be written"), std::string::npos) << error;
}

TEST(PrepareOutput, MakesAFolderThatIsNotThere) {
    const TemporaryFolder folder;
    EXPECT_EQ(prepare_output(folder / "new/run"), "");
    EXPECT_TRUE(fs::is_directory(folder / "new/run"));
}

TEST(PrepareOutput, TakesAnEmptyFolder) {
    const TemporaryFolder folder;
    EXPECT_EQ(prepare_output(folder.path()), "");
}

TEST(PrepareOutput, EmptiesAFolderThatHoldsASession) {
    const TemporaryFolder folder;
    Recorder::create(folder / "session.db", {}).recorder.reset();
    ASSERT_EQ(write_file(folder / "report.html", "old"), "");

    EXPECT_EQ(prepare_output(folder.path()), "");
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(PrepareOutput, KnowsASessionThatWasKilledAtOnce) {
    const TemporaryFolder folder, copy;
    const auto created = Recorder::create(folder / "session.db", {});
    fs::copy_file(folder / "session.db", copy / "session.db");  // as the disk has it while the recorder still runs
    EXPECT_EQ(prepare_output(copy.path()), "");
}

TEST(PrepareOutput, LeavesAnotherFolderAlone) {
    const TemporaryFolder folder;
    ASSERT_EQ(write_file(folder / "thesis.txt", "years of work"), "");

    EXPECT_NE(prepare_output(folder.path()), "");
    EXPECT_EQ(contents_of(folder / "thesis.txt"), "years of work");
}

TEST(PrepareOutput, LeavesSomebodysFilesBesideASessionAlone) {
    const TemporaryFolder folder;
    Recorder::create(folder / "session.db", {}).recorder.reset();
    ASSERT_EQ(write_file(folder / "thesis.txt", "years of work"), "");

    EXPECT_NE(prepare_output(folder.path()).find("thesis.txt"), std::string::npos);
    EXPECT_EQ(contents_of(folder / "thesis.txt"), "years of work");
    EXPECT_TRUE(fs::exists(folder / "session.db"));
}

TEST(PrepareOutput, IsNotFooledByTheNameOfASession) {
    const TemporaryFolder folder;
    ASSERT_EQ(write_file(folder / "session.db", std::string(4096, 'x')), "");
    EXPECT_NE(prepare_output(folder.path()), "");
    EXPECT_TRUE(fs::exists(folder / "session.db"));
}

TEST(PrepareOutput, RefusesAFile) {
    const TemporaryFolder folder;
    ASSERT_EQ(write_file(folder / "run", "text"), "");
    EXPECT_NE(prepare_output(folder / "run"), "");
}

}  // namespace
}  // namespace kerf
